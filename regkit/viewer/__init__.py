"""The viewer: scenes of recordings, models and verdicts, and the page that shows them."""
