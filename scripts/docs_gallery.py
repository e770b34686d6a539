"""Hook of mkdocs: the examples are pages of the site, as they stand in examples/."""

import pathlib

from mkdocs.structure.files import File

PAGES = ("README.md", "picture.png", "case.toml", "expected.py")


def on_files(files, config):
    root = pathlib.Path(config["config_file_path"]).parent
    for path in sorted((root / "examples").rglob("*")):
        if path.name in PAGES:
            files.append(File(path.relative_to(root).as_posix(), str(root), config["site_dir"], config["use_directory_urls"]))
    return files


def on_page_markdown(markdown, page, **_):
    # Links to the documentation leave the folder of the examples; on the site it is one of the documentation's own.
    if not page.file.src_uri.startswith("examples/"):
        return markdown
    case = pathlib.Path(page.file.abs_src_path).parent / "case.toml"
    if case.exists():
        markdown += f"\n## The case\n\n```toml\n{case.read_text()}```\n"
    return markdown.replace("](../../docs/", "](../../").replace("](../docs/", "](../")
