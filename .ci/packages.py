"""Packs each crate that can be published, and checks that all of them build from what is packed alone."""
import json, shutil, subprocess, tarfile, time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
UNPACKED = ROOT / "target" / "packages"
LARGEST = 10 * 2**20  # bytes, the limit of crates.io


def cargo(*words, folder=ROOT):
    return subprocess.run(["cargo", *words], cwd=folder, check=True, capture_output="metadata" in words).stdout


def published():
    """Name and version of each crate of the workspace that may be published."""
    packages = json.loads(cargo("metadata", "--no-deps", "--offline", "--format-version", "1"))["packages"]
    return [(package["name"], package["version"]) for package in packages if package["publish"] != []]


def unpacked(member, folder):
    """A packed file with the present time: packed times are all the same, and by them Cargo would see no change."""
    return tarfile.data_filter(member, folder).replace(mtime=time.time())


def unpack(name, version):
    archive = ROOT / "target" / "package" / f"{name}-{version}.crate"
    if archive.stat().st_size > LARGEST:
        raise SystemExit(f"{archive.name} has {archive.stat().st_size} bytes, more than {LARGEST}")
    with tarfile.open(archive) as files:
        files.extractall(UNPACKED, filter=unpacked)
    (UNPACKED / f"{name}-{version}").rename(UNPACKED / name)
    print(f"{name}: {archive.stat().st_size // 1000} kB")


def workspace(names):
    """A workspace of the unpacked crates, with the profiles and the versions of this one, so that what is built is shared."""
    manifest = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
    profiles = manifest[manifest.index("[profile.dev]") : manifest.index("[profile.release]")]
    paths = "".join(f'{name} = {{ path = "{name}" }}\n' for name in names)
    members = ", ".join(f'"{name}"' for name in names)
    text = f'[workspace]\nmembers = [{members}]\nresolver = "3"\n\n[patch.crates-io]\n{paths}\n{profiles}'
    (UNPACKED / "Cargo.toml").write_text(text, encoding="utf-8")
    shutil.copy(ROOT / "Cargo.lock", UNPACKED)


def main():
    crates = published()
    names = [name for name, _ in crates]
    chosen = [word for name in names for word in ("-p", name)]
    cargo("package", "--quiet", "--no-verify", "--allow-dirty", *chosen)
    shutil.rmtree(UNPACKED, ignore_errors=True)
    UNPACKED.mkdir(parents=True)
    for name, version in crates:
        unpack(name, version)
    workspace(names)
    cargo("check", "--quiet", "--workspace", "--lib", "--bins", "--target-dir", str(ROOT / "target"), folder=UNPACKED)


if __name__ == "__main__":
    main()
