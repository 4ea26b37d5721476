"""How the checks of this folder tell what they found."""


def report(problems, subject):
    """Prints the problems, or that there are none; the exit code."""
    found = list(problems)
    print("\n".join(found) if found else f"{subject}: no problem")
    return 1 if found else 0
