"""What a scheme could not follow."""


class UnresolvedWarning(UserWarning):
    """A step turned too far, was damped too stiffly or met too many torque edges for the sub-step limits: what
    follows it is not to be trusted. The text says what to do; ``warnings.simplefilter("error",
    adstar.UnresolvedWarning)`` makes it an error."""
