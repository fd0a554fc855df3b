"""Noise models of depth cameras, and presets of known cameras."""

from regkit.sensors.noise.model import DepthNoise
from regkit.sensors.noise.presets import NOISES, NoiseChoice, NoiseName, noise_of

__all__ = ["NOISES", "DepthNoise", "NoiseChoice", "NoiseName", "noise_of"]
