"""Animated pictures of tracks: GIF and WebP for slides and web pages, drawn without a browser."""
