//! Converts LaTeX to MathML with math-core. math-core copies operator names unchanged, recurses on
//! nested input, and panics on a stray `&`; therefore the output is checked, the stack size is
//! chosen to suit, and a panic becomes an error.

use std::panic;
use std::thread;

use math_core::{ConvertResult, LatexToMathML, MathDisplay};

/// The elements that math-core itself writes: MathML, and the possible output of `\text{}`. Any
/// other element comes from the formula and could be a script.
const ELEMENTS: &str = "math menclose mfrac mi mmultiscripts mn mo mover mpadded mphantom \
    mprescripts mroot mrow mspace msqrt msub msubsup msup mtable mtd mtext mtr munder munderover \
    b code em i s span u";

/// The allowed attributes: none of them is an address or an event handler.
const ATTRIBUTES: &str = "accent accentunder class display displaystyle form height largeop \
    linethickness lspace mathvariant maxsize minsize movablelimits notation rspace scriptlevel \
    stretchy style symmetric width";

/// A prime as an exponent, in full size and lowered; the font has it raised.
const PRIME: &str = "<mpadded voffset='-0.55em' scriptlevel='0'><mo>′</mo></mpadded></msup>";

/// Limit on the length of a formula (bytes).
const LONGEST: usize = 20_000;
/// A formula of this length (bytes) fits into the stack of any thread.
const SHORT: usize = 100;
/// An upper bound on the stack per byte of LaTeX, in an unoptimized build (bytes).
const STACK: usize = 16_384;

/// The formula as MathML, or the error, which quotes the formula.
pub(super) fn converted(
    math: &LatexToMathML,
    latex: &str,
    display: MathDisplay,
) -> Result<String, String> {
    if latex.len() > LONGEST {
        let start: String = latex.chars().take(40).collect();
        let length = latex.len();
        return Err(format!("the equation {start:?}… has {length} bytes, more than {LONGEST}"));
    }
    let convert = || {
        math.convert_with_local_state(latex, display).map_err(|error| {
            let mut reason = String::new();
            error.to_message(&mut reason, latex);
            format!("the equation {latex:?} at character {reason}")
        })
    };
    let ConvertResult { mathml, .. } = if latex.len() <= SHORT {
        panic::catch_unwind(panic::AssertUnwindSafe(convert)).unwrap_or_else(|_| unset())
    } else {
        with_stack(latex.len() * STACK, convert)
    }?;
    if let Some(tag) = foreign(&mathml) {
        return Err(format!("the equation {latex:?} has a tag that is not MathML: {tag:?}"));
    }
    match incomplete(&mathml) {
        Some(name) => Err(format!("the equation {latex:?} has an {name} without all its parts")),
        None => Ok(mathml.replace("<mo>′</mo></msup>", PRIME)),
    }
}

fn unset<T>() -> Result<T, String> {
    Err("an equation cannot be typeset".into())
}

/// Runs the work on a thread with this stack size (bytes); in a browser, which has no threads, on
/// this one.
fn with_stack<T: Send>(
    size: usize,
    work: impl FnOnce() -> Result<T, String> + Send,
) -> Result<T, String> {
    if cfg!(target_os = "emscripten") {
        return work();
    }
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(size).spawn_scoped(scope, work);
        let thread = thread.map_err(|cause| format!("no thread for an equation: {cause}"))?;
        thread.join().unwrap_or_else(|_| unset())
    })
}

/// The first tag that math-core does not write itself, or that closes another element than the open
/// one.
fn foreign(mathml: &str) -> Option<&str> {
    let mut open = Vec::new();
    let tags = mathml.split('<').skip(1).map(|piece| piece.split('>').next().unwrap_or(piece));
    tags.into_iter().find(|tag| {
        if let Some(name) = tag.strip_prefix('/') {
            return open.pop() != Some(name);
        }
        let (name, attributes) = tag.split_once([' ', '/']).unwrap_or((tag, ""));
        if !tag.ends_with('/') {
            open.push(name);
        }
        !(has(ELEMENTS, name) && are_own(attributes))
    })
}

/// Elements with a fixed number of children.
const PARTS: [(&str, usize); 8] = [
    ("mfrac", 2),
    ("mroot", 2),
    ("msub", 2),
    ("msup", 2),
    ("msubsup", 3),
    ("munder", 2),
    ("mover", 2),
    ("munderover", 3),
];

/// The first element with a missing child, for example a power without a base.
fn incomplete(mathml: &str) -> Option<&str> {
    let mut open: Vec<(&str, usize)> = Vec::new();
    for tag in mathml.split('<').skip(1) {
        let tag = tag.split('>').next().unwrap_or(tag);
        if tag.starts_with('/') {
            let (name, parts) = open.pop()?;
            if PARTS.iter().any(|&(known, all)| known == name && parts != all) {
                return Some(name);
            }
            continue;
        }
        if let Some((_, parts)) = open.last_mut() {
            *parts += 1;
        }
        if !tag.ends_with('/') {
            open.push((tag.split([' ', '/']).next().unwrap_or(tag), 0));
        }
    }
    None
}

/// Whether all attribute names are allowed; names and values alternate, as in
/// `width="1em" class="a"/`.
fn are_own(attributes: &str) -> bool {
    let mut names = attributes.split('"').step_by(2).map(|name| name.trim_matches([' ', '/']));
    names.all(|name| name.is_empty() || name.strip_suffix('=').is_some_and(|n| has(ATTRIBUTES, n)))
}

fn has(list: &str, name: &str) -> bool {
    list.split(' ').any(|own| own == name)
}
