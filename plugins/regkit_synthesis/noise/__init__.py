"""Noise models of depth cameras, and presets of known cameras."""

from regkit_synthesis.noise.model import DepthNoise
from regkit_synthesis.noise.presets import NOISES, NoiseChoice, NoiseName, noise_of

__all__ = ["NOISES", "DepthNoise", "NoiseChoice", "NoiseName", "noise_of"]
