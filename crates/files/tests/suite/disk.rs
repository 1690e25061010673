//! Names that the program chooses inside a folder lead to files of that folder and to no others.

use std::fs;
use std::path::Path;

use lcplab_files::disk::{inside, made_by, prepare, write_in};

#[test]
fn a_name_that_leads_out_of_its_folder_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["../a", "/a", "a/../../b", ".."] {
        let refused = write_in(folder.path(), name, "x").unwrap_err().to_string();
        assert!(refused.ends_with(": leads out of its folder"), "{name}: {refused}");
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    assert_eq!(inside(folder.path(), "a/b.csv").unwrap(), folder.path().join("a/b.csv"));
}

#[cfg(unix)]
#[test]
fn no_link_is_followed_whatever_it_leads_to() {
    use std::os::unix::fs::symlink;
    let all = tempfile::tempdir().unwrap();
    let (folder, home) = (all.path().join("folder"), all.path().join("home"));
    fs::create_dir(&home).unwrap();
    fs::write(home.join("keys"), "keys").unwrap();
    // A file, a folder, nothing, the parent, and a link to a link.
    let targets = ["../home/keys", "../home", "../home/new", "..", "other"];
    for target in targets {
        for link in ["a", "deep/a"] {
            fs::create_dir_all(folder.join("deep")).unwrap();
            symlink("../home", folder.join("other")).unwrap();
            symlink(target, folder.join(link)).unwrap();
            for name in [link.to_string(), format!("{link}/keys"), format!("{link}/b/c")] {
                let refused = [
                    write_in(&folder, &name, "x").unwrap_err(),
                    prepare(&folder, &[name.as_str()]).unwrap_err(),
                ];
                for error in refused {
                    let expected = format!("{}: is a symbolic link", folder.join(link).display());
                    assert!(error.to_string().starts_with(&expected), "{error}");
                }
            }
            assert_eq!(fs::read_dir(&home).unwrap().count(), 1);
            assert_eq!(fs::read_to_string(home.join("keys")).unwrap(), "keys");
            assert_eq!(fs::read_dir(all.path()).unwrap().count(), 2);
            fs::remove_dir_all(&folder).unwrap();
        }
    }
}

#[test]
fn what_another_program_made_takes_its_place_whole() {
    let folder = tempfile::tempdir().unwrap();
    let put = |path: &Path| {
        fs::write(path, "made").unwrap();
        Ok(())
    };
    let path = folder.path().join("a.txt");
    made_by(&path, put).unwrap();
    assert_eq!(fs::read_to_string(path).unwrap(), "made");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
