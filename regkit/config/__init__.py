"""Configuration: YAML documents, models, plug-ins and presets.

- ``yaml``, ``document``: YAML as plain data whose values know their line.
- ``model``: the base class of everything in YAML; ``strict_numbers``: its rules for numbers.
- ``plugin``, ``complete``: the base class of plug-ins, and what a plug-in must declare.
- ``installed``, ``registry``, ``defaults``: plug-ins by name, from entry points or registered.
- ``slot``, ``preset``, ``changes``: how the value of a field becomes a plug-in.
- ``former``: old names, answered with the new ones.
- ``slot_schema``, ``schema_line``: JSON Schema for editors.
"""
