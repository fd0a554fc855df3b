"""Configuration: documents with line numbers, models, plug-ins and slots, presets, schemas."""
