#!/bin/sh
# Prints a header as Doxygen understands it: `docs/page.md#heading` in a comment is no link to a symbol `heading`.
exec sed -E 's,(docs/[a-z_]+\.md)#,\1: ,' "$1"
