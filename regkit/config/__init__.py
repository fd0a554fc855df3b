"""Configuration: YAML documents, models, plug-ins and presets.

- ``yaml`` and ``yaml_*``, ``document``: YAML as plain data whose values know their line.
- ``model``: the base class of everything in YAML; ``strict_numbers``: its rules for numbers.
- ``quantities``: types of numbers with bounds.
- ``parts``, ``input_files``: walks through a configuration, and the files that it names.
- ``plugin``, ``complete``: the base class of plug-ins, and what a plug-in must declare.
- ``installed``, ``registry``, ``defaults``: plug-ins by name, from entry points or registered.
- ``slot``, ``preset``, ``changes``: how the value of a field becomes a plug-in.
- ``former``: old names, answered with the new ones.
- ``slot_schema``, ``schema_line``: JSON Schema for editors.
- ``first_sentence``: what a YAML file says of itself, for lists.
"""
