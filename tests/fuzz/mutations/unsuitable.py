"""What a mutation says of a content that it cannot be done to."""


class UnsuitableError(Exception):
    """The content is not what the mutation needs, often after an earlier mutation."""
