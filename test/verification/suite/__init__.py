"""What the verification cases share: running `simulate`, judging a figure, drawing."""
