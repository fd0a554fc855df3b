"""The system below: errors, arrays, files, the cache, compiled loops and optional libraries."""
