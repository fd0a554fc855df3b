"""What depth cameras make of what there is to be seen."""

from regkit_synthesis.noise.model import DepthNoise
from regkit_synthesis.noise.presets import NOISES, NoiseChoice, NoiseName, noise_of

__all__ = ["NOISES", "DepthNoise", "NoiseChoice", "NoiseName", "noise_of"]
