//! Every variant of every kind of trouble is produced by the library, with the right message.
//!
//! The matches are exhaustive: a variant that is added does not compile without a case here. A type
//! that may grow cannot be matched so in another crate; its variants are read from its source.

/// Checks each variant: a value that the library makes, and what it says.
macro_rules! each_variant {
    ($kind:ident: $($variant:pat => $made:expr, $words:expr;)+) => {{
        #[allow(unused_variables)]
        let _ = |value: $kind| match value { $($variant => ()),+ };
        $( each_variant!(@one $kind, $variant, $made, $words); )+
    }};
    ($kind:ident in $source:literal: $($variant:pat => $made:expr, $words:expr;)+) => {{
        let source = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/", $source));
        let listed = [$(stringify!($variant)),+].map($crate::messages::name);
        assert_eq!(listed.to_vec(), $crate::messages::variants(source, stringify!($kind)));
        $( each_variant!(@one $kind, $variant, $made, $words); )+
    }};
    (@one $kind:ident, $variant:pat, $made:expr, $words:expr) => {
        let made: $kind = $made;
        let $variant = &made else { panic!("{made:?}") };
        assert_eq!(made.to_string(), $words);
    };
}

mod cause;
mod error;
mod mistake;
mod status;

/// The name in a pattern such as `Status::Ray { .. }`.
fn name(pattern: &str) -> &str {
    let (_, name) = pattern.split_once("::").unwrap();
    name.split(|c: char| !c.is_alphanumeric()).next().unwrap()
}

/// The variants of an enumeration, in the order of its source.
fn variants<'a>(source: &'a str, kind: &str) -> Vec<&'a str> {
    let (_, body) = source.split_once(&format!("pub enum {kind} {{\n")).unwrap();
    let (body, _) = body.split_once("\n}").unwrap();
    let lines = body.lines().filter_map(|line| line.strip_prefix("    "));
    let lines = lines.filter(|line| line.starts_with(|c: char| c.is_ascii_uppercase()));
    lines.map(|line| line.split(|c: char| !c.is_alphanumeric()).next().unwrap()).collect()
}
