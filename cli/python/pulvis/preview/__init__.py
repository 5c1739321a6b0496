"""Draws and labels the set-up of a scene before it runs: `pulvis preview` writes the set-up as JSON (with
-o FILE.json), and this package draws it."""
