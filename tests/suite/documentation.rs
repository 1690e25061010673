//! Every public function is called in an example of its crate's documentation, which rustdoc runs.
//!
//! The public functions are those of the modules that a user of the crate can name, by `pub mod`
//! and `pub use`, without hidden ones; methods of public types and of public traits count too.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use syn::{Attribute, ImplItem, Item, Meta, TraitItem, Type, UseTree, Visibility};

/// A function, and where it is defined.
#[derive(Clone)]
struct Function {
    name: String,
    /// The type or trait that has it.
    owner: Option<String>,
    is_of_trait: bool,
    has_self: bool,
    /// The module; the root has no name.
    module: String,
    file: PathBuf,
}

impl Function {
    fn title(&self) -> String {
        let owner = self.owner.as_ref().map(|owner| format!("{owner}::")).unwrap_or_default();
        format!("{}: {owner}{}", self.file.display(), self.name)
    }
}

/// A `pub use` of a module, of an item of one or, as `*`, of all its items.
struct Reexport {
    path: Vec<String>,
    /// The item's new name.
    name: String,
}

#[derive(Default)]
struct Module {
    functions: Vec<Function>,
    /// The functions of types and traits, in the module that implements them.
    methods: Vec<Function>,
    public_items: BTreeSet<String>,
    public_modules: BTreeSet<String>,
    reexports: Vec<Reexport>,
}

/// The modules of a crate by their paths; the root has the empty one.
#[derive(Default)]
struct Modules(BTreeMap<Vec<String>, Module>);

fn is_public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// Whether an item is hidden from the documentation or compiled for tests only.
fn is_left_out(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) if list.path.is_ident("doc") => list.tokens.to_string() == "hidden",
        Meta::List(list) if list.path.is_ident("cfg") => {
            ["test", "doctest"].contains(&list.tokens.to_string().as_str())
        }
        _ => false,
    })
}

fn names(tree: &UseTree, path: &mut Vec<String>, found: &mut Vec<Reexport>) {
    let (last, name) = match tree {
        UseTree::Path(next) => {
            path.push(next.ident.to_string());
            names(&next.tree, path, found);
            path.pop();
            return;
        }
        UseTree::Group(group) => {
            group.items.iter().for_each(|tree| names(tree, path, found));
            return;
        }
        UseTree::Name(name) => (name.ident.to_string(), name.ident.to_string()),
        UseTree::Rename(name) => (name.ident.to_string(), name.rename.to_string()),
        UseTree::Glob(_) => ("*".to_string(), "*".to_string()),
    };
    let mut whole = path.clone();
    if last != "self" {
        whole.push(last);
    }
    found.push(Reexport { path: whole, name });
}

/// A path in a `use` of this module, from the root of the crate; another crate's is no module.
fn absolute(module: &[String], path: &[String]) -> Vec<String> {
    let mut whole = match path.first().map(String::as_str) {
        Some("crate") => Vec::new(),
        Some("super") => module[..module.len() - 1].to_vec(),
        _ => module.to_vec(),
    };
    let is_relative = |name: &&String| ["crate", "self", "super"].contains(&name.as_str());
    whole.extend(path.iter().skip_while(is_relative).cloned());
    whole
}

impl Modules {
    /// Reads a module's items; its own modules lie in `folder`.
    fn read(&mut self, items: Vec<Item>, path: &[String], file: &Path, folder: &Path) {
        let mut module = Module::default();
        let function = |signature: &syn::Signature, owner: Option<&str>| Function {
            name: signature.ident.to_string(),
            owner: owner.map(str::to_string),
            is_of_trait: false,
            has_self: signature.receiver().is_some(),
            module: path.last().cloned().unwrap_or_default(),
            file: file.to_path_buf(),
        };
        for item in items {
            match item {
                Item::Fn(item) if is_public(&item.vis) && !is_left_out(&item.attrs) => {
                    module.functions.push(function(&item.sig, None));
                }
                Item::Struct(item) if is_public(&item.vis) && !is_left_out(&item.attrs) => {
                    module.public_items.insert(item.ident.to_string());
                }
                Item::Enum(item) if is_public(&item.vis) && !is_left_out(&item.attrs) => {
                    module.public_items.insert(item.ident.to_string());
                }
                Item::Trait(item) if is_public(&item.vis) && !is_left_out(&item.attrs) => {
                    let owner = item.ident.to_string();
                    for item in item.items {
                        if let TraitItem::Fn(item) = item
                            && !is_left_out(&item.attrs)
                        {
                            let method = function(&item.sig, Some(&owner));
                            module.methods.push(Function { is_of_trait: true, ..method });
                        }
                    }
                    module.public_items.insert(owner);
                }
                Item::Impl(item) if item.trait_.is_none() && !is_left_out(&item.attrs) => {
                    let Type::Path(owner) = &*item.self_ty else { continue };
                    let owner = owner.path.segments.last().unwrap().ident.to_string();
                    for item in item.items {
                        if let ImplItem::Fn(item) = item
                            && is_public(&item.vis)
                            && !is_left_out(&item.attrs)
                        {
                            module.methods.push(function(&item.sig, Some(&owner)));
                        }
                    }
                }
                Item::Use(item) if is_public(&item.vis) && !is_left_out(&item.attrs) => {
                    names(&item.tree, &mut Vec::new(), &mut module.reexports);
                }
                Item::Mod(item) if !is_left_out(&item.attrs) => {
                    let name = item.ident.to_string();
                    let inner = [path, std::slice::from_ref(&name)].concat();
                    let folder = folder.join(&name);
                    match item.content {
                        Some((_, items)) => self.read(items, &inner, file, &folder),
                        None => {
                            let beside = folder.with_extension("rs");
                            let file = if beside.exists() { beside } else { folder.join("mod.rs") };
                            self.read_file(&inner, &file, &folder);
                        }
                    }
                    if is_public(&item.vis) {
                        module.public_modules.insert(name);
                    }
                }
                _ => {}
            }
        }
        self.0.insert(path.to_vec(), module);
    }

    fn read_file(&mut self, path: &[String], file: &Path, folder: &Path) {
        let text = fs::read_to_string(file).unwrap();
        let parsed = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        self.read(parsed.items, path, file, folder);
    }

    /// The public functions, by the modules and items that can be named from outside.
    fn public_functions(&self) -> Vec<Function> {
        let mut whole = BTreeSet::new(); // modules with all that is public in them
        let mut single = BTreeMap::new(); // (module, item), and its name outside
        let mut open = vec![Vec::new()];
        while let Some(path) = open.pop() {
            let Some(module) = self.0.get(&path) else { continue };
            if !whole.insert(path.clone()) {
                continue;
            }
            for name in &module.public_modules {
                open.push([&path[..], std::slice::from_ref(name)].concat());
            }
            for reexport in &module.reexports {
                self.follow(&path, reexport, &mut open, &mut single);
            }
        }
        let mut types = BTreeSet::new();
        for (path, module) in &self.0 {
            for item in &module.public_items {
                if whole.contains(path) || single.contains_key(&(path.clone(), item.clone())) {
                    types.insert(item.clone());
                }
            }
        }
        let mut found = Vec::new();
        for (path, module) in &self.0 {
            for function in &module.functions {
                let renamed = single.get(&(path.clone(), function.name.clone()));
                let own = whole.contains(path).then_some(&function.name);
                if let Some(name) = own.or(renamed) {
                    found.push(Function { name: name.clone(), ..function.clone() });
                }
            }
            let is_owned = |f: &&Function| f.owner.as_ref().is_some_and(|o| types.contains(o));
            found.extend(module.methods.iter().filter(is_owned).cloned());
        }
        found
    }

    /// Notes what a `pub use` of a module makes public: a module, all of one, or an item.
    fn follow(
        &self,
        module: &[String],
        reexport: &Reexport,
        open: &mut Vec<Vec<String>>,
        single: &mut BTreeMap<(Vec<String>, String), String>,
    ) {
        let mut target = absolute(module, &reexport.path);
        if self.0.contains_key(&target) {
            open.push(target);
            return;
        }
        let Some(last) = target.pop() else { return };
        if last == "*" {
            open.push(target);
        } else if let Some(inner) = self.0.get(&target) {
            // The module may itself name it from a deeper one.
            let name = reexport.name.clone();
            if single.insert((target.clone(), last.clone()), name).is_none() {
                for deeper in inner.reexports.iter().filter(|r| r.path.last() == Some(&last)) {
                    self.follow(&target, deeper, open, single);
                }
            }
        }
    }
}

/// An example: the lines that a reader sees, and the file.
struct Example {
    file: PathBuf,
    code: String,
}

/// The examples in a file's documentation comments that rustdoc runs.
fn examples(file: &Path) -> Vec<Example> {
    let text = fs::read_to_string(file).unwrap();
    let mut found = Vec::new();
    let mut block: Option<(bool, String)> = None;
    for line in text.lines() {
        let line = line.trim_start();
        let Some(line) = line.strip_prefix("///").or_else(|| line.strip_prefix("//!")) else {
            block = None;
            continue;
        };
        let line = line.trim();
        if let Some(language) = line.strip_prefix("```") {
            block = match block {
                Some((is_run, code)) => {
                    if is_run {
                        found.push(Example { file: file.to_path_buf(), code });
                    }
                    None
                }
                None => Some((["", "rust", "should_panic"].contains(&language), String::new())),
            };
        } else if let Some((_, code)) = &mut block
            && line != "#"
            && !line.starts_with("# ")
        {
            code.push_str(line.split("// ").next().unwrap());
            code.push('\n');
        }
    }
    found
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The text before and after each place of a word.
fn places<'a>(code: &'a str, word: &str) -> Vec<(&'a str, &'a str)> {
    let all = code.match_indices(word).map(|(k, _)| (&code[..k], &code[k + word.len()..]));
    all.filter(|(before, after)| !before.ends_with(is_word) && !after.starts_with(is_word))
        .collect()
}

impl Example {
    /// Whether the example calls a function of this name.
    fn calls(&self, function: &Function) -> bool {
        places(&self.code, &function.name).into_iter().any(|(before, after)| {
            let is_called = after.starts_with('(') || after.starts_with("::<");
            match &function.owner {
                None => {
                    is_called
                        && !before.trim_end().ends_with(['.', ']'])
                        && !before.ends_with("fn ")
                }
                // A user of a trait may also implement it.
                Some(_) if function.is_of_trait && before.ends_with("fn ") => true,
                Some(_) if function.has_self => {
                    (is_called && before.trim_end().ends_with('.')) || before.ends_with("::")
                }
                Some(owner) => before.ends_with(&format!("{owner}::")) || before.ends_with(">::"),
            }
        })
    }

    /// Whether the example is in the function's file or in that of its folder, or names its type,
    /// or for a function its module.
    fn is_about(&self, function: &Function) -> bool {
        let owner = function.owner.as_ref().unwrap_or(&function.module);
        let folder = function.file.parent().unwrap();
        self.file == function.file
            || self.file == folder.join("mod.rs")
            || self.file == folder.with_extension("rs")
            || !owner.is_empty() && !places(&self.code, owner).is_empty()
    }
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// The number of public functions of a crate, and those that no example calls. Where several
/// functions share a name, the example must be in the file of the function or name its type.
fn without_example(src: &Path) -> (usize, Vec<String>) {
    let mut modules = Modules::default();
    modules.read_file(&[], &src.join("lib.rs"), src);
    let functions = modules.public_functions();
    let examples: Vec<Example> = sources(src).iter().flat_map(|file| examples(file)).collect();
    let mut named = BTreeMap::new();
    for function in &functions {
        *named.entry(&function.name).or_insert(0) += 1;
    }
    let has_example = |function: &Function| {
        let mut calls = examples.iter().filter(|example| example.calls(function));
        calls.any(|example| named[&function.name] == 1 || example.is_about(function))
    };
    let missing = functions.iter().filter(|f| !has_example(f)).map(Function::title).collect();
    (functions.len(), missing)
}

#[test]
fn every_public_function_is_called_in_an_example() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut crates: Vec<PathBuf> =
        fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().path()).collect();
    crates.push(root.to_path_buf());
    crates.sort();
    let (mut count, mut missing) = (0, Vec::new());
    for folder in crates {
        let (functions, own) = without_example(&folder.join("src"));
        count += functions;
        missing.extend(own);
    }
    assert!(count > 500, "only {count} public functions were found");
    assert!(missing.is_empty(), "no example calls\n{}", missing.join("\n"));
}
