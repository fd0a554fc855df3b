"""Sources, which yield frames with their time: recordings of any format, and cameras.

- ``folder``: recordings in regkit's own folder format.
"""
