//! The markup of a page's text: Markdown (CommonMark and tables) with LaTeX between dollar signs.
//!
//! ```text
//! *word*, **word**, `word`, [word](address), lists, tables, $x^2$, $$x^2$$ on a line of its own
//! ```
//!
//! HTML is shown as text. A page loads no other files, so a picture, ![words](address), becomes its
//! words and a link.

use math_core::{LatexToMathML, MathDisplay};
use pulldown_cmark::{CowStr, Event, Options, Parser, Tag, TagEnd, html::push_html};

use super::mathml;
use crate::escape::html;

/// Text with all markup characters escaped.
///
/// ```
/// use lcplab_page::page::markup::literal;
///
/// assert_eq!(literal("no markup"), "no markup");
/// assert_ne!(literal("*m* g"), "*m* g"); // asterisks are escaped
/// ```
pub fn literal(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if c.is_ascii_punctuation() {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// The inverse of [`literal`]: markup without the backslashes of escaped characters.
pub(super) fn unescaped(markup: &str) -> String {
    let mut out = String::new();
    let mut rest = markup.chars().peekable();
    while let Some(c) = rest.next() {
        let escapes = c == '\\' && rest.peek().is_some_and(char::is_ascii_punctuation);
        out.extend(if escapes { rest.next() } else { Some(c) });
    }
    out
}

/// At the start of a text, it prevents a list or a heading.
const WORD_JOINER: &str = "\u{2060}";

/// Signs that stay with the formula before them.
const PUNCTUATION: [char; 5] = [',', '.', ';', ':', ')'];

/// Turns markup into HTML and equations into MathML. An error is a sentence that quotes the invalid
/// part.
#[derive(Default)]
pub(super) struct Renderer {
    math: LatexToMathML,
}

impl Renderer {
    /// Paragraphs, lists and tables.
    pub fn blocks(&self, text: &str) -> Result<String, String> {
        let mut out = String::new();
        push_html(&mut out, self.events(text)?.into_iter());
        // The text cannot contain HTML tags, so these are tables. A wide one scrolls in a frame.
        let frame = "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"Table\">";
        let out = out.replace("<table>", &format!("{frame}<table>"));
        let out = out.replace("</table>", "</table></div>");
        Ok(out
            .replace("<th>", "<th scope=\"col\">")
            .replace("<th style", "<th scope=\"col\" style"))
    }

    /// Inline text.
    pub fn inline(&self, text: &str) -> Result<String, String> {
        let line = format!("{WORD_JOINER}{}", text.replace('\n', " "));
        let html = self.blocks(&line)?.replace(WORD_JOINER, "");
        Ok(html.trim_end().trim_start_matches("<p>").trim_end_matches("</p>").to_string())
    }

    /// A displayed equation; on a narrow screen its parts, between spaces of a quad, stand below
    /// each other.
    pub fn equation(&self, latex: &str) -> Result<String, String> {
        let parts = parts(&latex.replace("\\qquad", "\\quad"));
        let math = parts.iter().map(|part| self.mathml(part, MathDisplay::Block));
        Ok(format!("<span class=\"parts\">{}</span>", math.collect::<Result<String, String>>()?))
    }

    fn events<'a>(&self, text: &'a str) -> Result<Vec<Event<'a>>, String> {
        let options = Options::ENABLE_MATH | Options::ENABLE_TABLES;
        let (mut events, mut pictures) = (Vec::new(), Pictures::default());
        for (event, range) in Parser::new_ext(text, options).into_offset_iter() {
            let event = self.event(event, text, range.start)?;
            match (events.last_mut(), event) {
                // A line does not begin with the comma after a formula.
                (Some(Event::InlineHtml(math)), Event::Text(words))
                    if math.ends_with("</math>") && words.starts_with(PUNCTUATION) =>
                {
                    let length = words.chars().take_while(|c| PUNCTUATION.contains(c)).count();
                    let (sign, rest) = words.split_at(length);
                    *math = format!("<span class=\"nobr\">{math}{sign}</span>").into();
                    events.push(Event::Text(rest.to_string().into()));
                }
                (_, event) => events.extend(pictures.linked(event)),
            }
        }
        Ok(events)
    }

    /// The event with mathematics converted and HTML escaped, after checking addresses and dollar
    /// signs.
    fn event<'a>(&self, event: Event<'a>, text: &str, at: usize) -> Result<Event<'a>, String> {
        let html = |mathml: String| Event::InlineHtml(CowStr::from(mathml));
        match event {
            Event::InlineMath(latex) => self.mathml(&latex, MathDisplay::Inline).map(html),
            Event::DisplayMath(latex) => self.equation(&latex).map(html),
            Event::Html(tag) => Ok(fold(&tag).map_or(Event::Text(tag), Event::Html)),
            Event::InlineHtml(tag) => Ok(Event::Text(tag)),
            Event::Start(Tag::Link { ref dest_url, .. } | Tag::Image { ref dest_url, .. }) => {
                safe(dest_url)?;
                Ok(event)
            }
            Event::Text(ref words) if words.contains('$') && !text[..at].ends_with('\\') => {
                Err(format!("a $ without a closing $: {:?}", shortened(&text[at..])))
            }
            event => Ok(event),
        }
    }

    fn mathml(&self, latex: &str, display: MathDisplay) -> Result<String, String> {
        mathml::converted(&self.math, latex, display)
    }
}

/// The open links and pictures at a position in a text.
#[derive(Default)]
struct Pictures<'a> {
    /// The links to the pictures whose words are being read.
    open: Vec<Tag<'a>>,
    /// The number of links around them: links cannot be nested.
    links: usize,
}

impl<'a> Pictures<'a> {
    /// The event; for a picture its words, and its address in parentheses.
    fn linked(&mut self, event: Event<'a>) -> Vec<Event<'a>> {
        match event {
            Event::Start(Tag::Image { link_type, dest_url, title, id }) => {
                self.open.push(Tag::Link { link_type, dest_url, title, id });
                Vec::new()
            }
            Event::End(TagEnd::Image) => {
                self.open.pop().map_or(Vec::new(), |link| self.close(link))
            }
            Event::Start(Tag::Link { .. }) => {
                self.links += 1;
                vec![event]
            }
            Event::End(TagEnd::Link) => {
                self.links -= 1;
                vec![event]
            }
            event => vec![event],
        }
    }

    fn close(&self, link: Tag<'a>) -> Vec<Event<'a>> {
        let Tag::Link { dest_url: address, .. } = &link else { return Vec::new() };
        let address = Event::Text(address.clone());
        let address = match self.links {
            0 => vec![Event::Start(link), address, Event::End(TagEnd::Link)],
            _ => vec![address],
        };
        let sign = |sign| Event::Text(CowStr::Borrowed(sign));
        [vec![sign(" (")], address, vec![sign(")")]].concat()
    }
}

/// The parts of an equation between spaces of a quad that are in no braces, brackets or matrices;
/// a text, such as a unit, stays with the part before it.
fn parts(latex: &str) -> Vec<String> {
    let is_open = |part: &str| {
        let part = part.replace("\\leftarrow", "");
        let count = |words: &str| part.matches(words).count();
        count("{") != count("}")
            || count("\\begin") != count("\\end")
            || count("\\left") != count("\\right")
    };
    let mut parts: Vec<String> = Vec::new();
    for part in latex.split("\\quad") {
        match parts.last_mut() {
            Some(last) if is_open(last) || part.trim_start().starts_with("\\text{") => {
                *last += &format!("\\quad{part}");
            }
            _ => parts.push(part.to_string()),
        }
    }
    parts.retain(|part| !part.trim().is_empty());
    parts
}

/// The lines that delimit collapsed text, the only HTML that is passed on: `<details>`, a
/// `<summary>` of plain words, `</details>`.
fn fold(line: &str) -> Option<CowStr<'static>> {
    let line = line.trim();
    let words = || line.strip_prefix("<summary>")?.strip_suffix("</summary>");
    match line {
        "<details>" | "</details>" => Some(format!("{line}\n").into()),
        _ => words().map(|words| format!("<summary>{}</summary>\n", html(words)).into()),
    }
}

/// The address, if it is a web address or a relative one; others could run scripts.
fn safe(address: &str) -> Result<&str, String> {
    let scheme = address.split(['/', '#', '?']).next().and_then(|start| start.split_once(':'));
    match scheme {
        None | Some(("https" | "http" | "mailto", _)) if !address.is_empty() => Ok(address),
        _ => Err(format!("the link {address:?} is neither a web address nor a relative address")),
    }
}

fn shortened(text: &str) -> String {
    text.chars().take(40).collect()
}
