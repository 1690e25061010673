//! LaTeX as MathML by math-core, which copies the names of operators as they stand, calls itself
//! for all that nests, and asserts what a stray `&` makes untrue: what it writes is checked, it
//! gets a stack to suit, and a panic is an error.

use std::panic;
use std::thread;

use math_core::{ConvertResult, LatexToMathML, MathDisplay};

/// What math-core writes of its own accord: MathML, and what `\text{}` may look like. Whatever else
/// is found was in the formula, and could be a script.
const ELEMENTS: &str = "math menclose mfrac mi mmultiscripts mn mo mover mpadded mphantom \
    mprescripts mroot mrow mspace msqrt msub msubsup msup mtable mtd mtext mtr munder munderover \
    b code em i s span u";

/// Neither an address nor what to do at an event.
const ATTRIBUTES: &str = "accent accentunder class display displaystyle form height largeop \
    linethickness lspace mathvariant maxsize minsize movablelimits notation rspace scriptlevel \
    stretchy style symmetric width";

/// A longer formula is none (bytes).
const LONGEST: usize = 20_000;
/// A formula of so many bytes fits into the stack of any thread.
const SHORT: usize = 100;
/// More stack than a byte of LaTeX takes, in a build that is not optimised (bytes).
const STACK: usize = 16_384;

/// The formula as MathML, or why not, in words that quote it.
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
        None => Ok(mathml),
    }
}

fn unset<T>() -> Result<T, String> {
    Err("an equation cannot be typeset".into())
}

/// Does it on a thread with so much stack (bytes).
fn with_stack<T: Send>(
    size: usize,
    work: impl FnOnce() -> Result<T, String> + Send,
) -> Result<T, String> {
    thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(size).spawn_scoped(scope, work);
        let thread = thread.map_err(|cause| format!("no thread for an equation: {cause}"))?;
        thread.join().unwrap_or_else(|_| unset())
    })
}

/// The first tag that is not math-core's own, or does not close what was opened.
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

/// Elements that have so many parts, no more and no fewer.
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

/// The first element that lacks a part: a power of nothing, say.
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

/// Whether the names of attributes are: names and values take turns, as in `width="1em"
/// class="a"/`.
fn are_own(attributes: &str) -> bool {
    let mut names = attributes.split('"').step_by(2).map(|name| name.trim_matches([' ', '/']));
    names.all(|name| name.is_empty() || name.strip_suffix('=').is_some_and(|n| has(ATTRIBUTES, n)))
}

fn has(list: &str, name: &str) -> bool {
    list.split(' ').any(|own| own == name)
}
