"""The set-up of a scene, drawn and labelled before it runs: `pulvis preview` writes what is to be drawn as JSON (with
-o FILE.json), and this package draws it."""
