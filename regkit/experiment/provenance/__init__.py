"""What results were made from, and whether their files are still those that were written.

- ``listing``: the files in a recording's or plug-in's inputs, by names without their place.
- ``recording``: the content of a recording.
- ``setup``: versions, code, templates and other files of an experiment.
- ``code``: the code of plug-ins.
- ``manifest``: the checksums of a finished track.
"""
