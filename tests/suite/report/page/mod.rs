//! Pages: self-contained, escaped, and every fault named with its place.

mod contrast;
mod sample;
mod valid;

use lcplab::plot::{Axis, Figure, Lines};
use lcplab::report::page::markup::literal;
use lcplab::report::page::{Block, Cell, Column, Mark, Origin, Page, Picture, Section, Table};

fn page(blocks: Vec<Block>) -> Page {
    let section = Section { id: "one".into(), title: "One".into(), blocks, ..Section::default() };
    Page { title: "Page".into(), sections: vec![section], ..Page::default() }
}

fn main_part(page: &Page) -> String {
    let html = page.render().unwrap();
    let (start, end) = (html.find("<main").unwrap(), html.find("</main>").unwrap());
    html[start..end].to_string()
}

fn text(markup: &str) -> String {
    let html = main_part(&page(vec![Block::Text(markup.into())]));
    let (start, end) = (html.find("</h2>").unwrap() + 5, html.rfind("</section>").unwrap());
    html[start..end].trim().to_string()
}

#[test]
fn markup_becomes_html() {
    assert_eq!(text("a *b* **c**\n\nd"), "<p>a <em>b</em> <strong>c</strong></p>\n<p>d</p>");
    assert_eq!(text("- `x < y`\n- z"), "<ul>\n<li><code>x &lt; y</code></li>\n<li>z</li>\n</ul>");
    assert_eq!(text("[a *b*](#c)"), "<p><a href=\"#c\">a <em>b</em></a></p>");
    assert!(text("$x_i$").starts_with("<p><math><msub>"));
}

#[test]
fn a_picture_that_a_page_does_not_load_keeps_its_address() {
    let link = "<a href=\"http://a.org/x.png\">http://a.org/x.png</a>";
    let alone = text("a ![page *image*](http://a.org/x.png) b");
    assert_eq!(alone, format!("<p>a page <em>image</em> ({link}) b</p>"));
    // A link holds no other one, and a picture may hold one or stand in one.
    let within = text("[![page](http://a.org/x.png)](http://b.org)");
    assert_eq!(within, "<p><a href=\"http://b.org\">page (http://a.org/x.png)</a></p>");
    let around = text("![[page](http://b.org)](http://a.org/x.png)");
    assert_eq!(around, format!("<p><a href=\"http://b.org\">page</a> ({link})</p>"));
    assert!(!text("![page](x.png \"title\")").contains("<img"));
}

#[test]
fn signs_without_a_partner_are_signs() {
    assert_eq!(text("x* - y, 2 * 3 * 4, a[3]"), "<p>x* - y, 2 * 3 * 4, a[3]</p>");
    assert_eq!(text("\\*a\\* \\$5 C:\\dir"), "<p>*a* $5 C:\\dir</p>");
}

#[test]
fn literal_text_reads_as_itself() {
    let name = "- my *scene* `[1](x)` $5 \\ <b>";
    assert_eq!(text(&literal(name)), "<p>- my *scene* `[1](x)` $5 \\ &lt;b&gt;</p>");
}

/// The text of the listings on a page, without what colors and folds them.
fn listed(language: &str, code: &str) -> Vec<String> {
    let block = Block::Code { language: language.into(), text: code.into() };
    let html = main_part(&page(vec![block]));
    let listings = html.split("<code class=").skip(1).map(|rest| {
        let inside = rest.split_once('>').unwrap().1.split("</code>").next().unwrap();
        let mut text = String::new();
        for piece in inside.split('<') {
            text += piece.split_once('>').map_or(piece, |(_, text)| text);
        }
        let signs =
            [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
        signs.iter().fold(text, |text, (name, sign)| text.replace(name, sign))
    });
    listings.collect()
}

#[test]
fn colors_change_no_sign_of_code() {
    let rust =
        "let é = \"a \\\" // b\"; // <&'> 'a\nfn f<'a>(x: &'a str) -> f64 { 1.5e3_f64 }\n\"no end";
    assert_eq!(listed("rust", rust), [rust]);
    let python = "def f(x='a\\'b', y=\"#\"):  # ' <\n    return x if y else 0x1f";
    assert_eq!(listed("python", python), [python]);
    assert_eq!(listed("toml", "a = 'b' # c"), ["a = 'b' # c"]);
    for (code, class, piece) in [
        ("let x = 1;", "word", "let"),
        ("letter = 25;", "number", "25"),
        ("// let x", "comment", "// let x"),
        ("f(\"if // x\")", "text", "&quot;if // x&quot;"),
    ] {
        let block = Block::Code { language: "rust".into(), text: code.into() };
        let html = main_part(&page(vec![block]));
        assert!(html.contains(&format!("<span class=\"{class}\">{piece}</span>")), "{html}");
    }
}

#[test]
fn imports_at_the_beginning_stand_apart() {
    let rust = "use a::{\n    b,\n    c,\n};\nuse d;\n\nlet e = 1;\nuse f;";
    assert_eq!(
        listed("rust", rust),
        ["use a::{\n    b,\n    c,\n};\nuse d;", "let e = 1;\nuse f;"]
    );
    let python = "from a import (\n    b,\n)\nimport c\n\nd = 1";
    assert_eq!(listed("python", python), ["from a import (\n    b,\n)\nimport c", "d = 1"]);
    let few = "use a;\nlet b = 1;";
    assert_eq!(listed("rust", few), [few]);
}

#[test]
fn text_is_escaped_everywhere() {
    let evil = "<script>alert(\"1\")</script>";
    let table = Table {
        title: evil.into(),
        how_to_read: evil.into(),
        columns: vec![Column { unit: evil.into(), ..Column::words(evil) }],
        rows: vec![vec![Cell::text(evil)]],
        files: vec![(evil.into(), "a\" onclick=\"b".into())],
        ..Table::default()
    };
    let mut page = page(vec![
        Block::Text(evil.into()),
        Block::Note(format!("`{evil}` $\\text{{{evil}}}$")),
        Block::Equation { latex: "x < y".into(), label: Some(evil.into()) },
        Block::Code { language: evil.into(), text: evil.into() },
        Block::Table(table),
    ]);
    page.title = evil.into();
    page.lead = evil.into();
    page.sections[0].title = evil.into();
    page.sections[0].origin =
        Some(Origin { scene: evil.into(), settings: evil.into(), command: evil.into() });
    page.facts = vec![(evil.into(), evil.into())];
    let html = page.render().unwrap();
    assert_eq!(html.matches("<script>").count(), 1, "our own");
    assert!(!html.contains("\" onclick"));
}

#[test]
fn no_formula_brings_tags_of_its_own() {
    let evil = [
        "<script>alert(1)</script>",
        "<img src=x onerror=alert(1)>",
        "<mi onclick=\"alert(1)\">x</mi>",
        "<mi href=\"https://example.org\">x</mi>",
        "</math>",
        "<mi>",
        "<svg/onload=alert(1)>",
        "<iframe",
        "<",
    ];
    let wraps = ["operatorname", "operatorname*", "mathrm", "text", "textbf", "mathop", "tag"];
    for (evil, wrap) in evil.iter().flat_map(|evil| wraps.map(|wrap| (evil, wrap))) {
        let latex = format!("\\{wrap}{{{evil}}}");
        let blocks = [Block::Equation { latex: latex.clone(), label: None }];
        let inline = [Block::Text(format!("${latex}$"))];
        for blocks in [blocks, inline] {
            if let Ok(html) = page(blocks.into()).render() {
                let main = &html[html.find("<main").unwrap()..html.find("</main>").unwrap()];
                let count = |piece: &str| main.matches(piece).count();
                let acting = ["<script", "<img", "<svg/", "<iframe", "<mi on", "<mi href"];
                assert!(acting.iter().all(|tag| count(tag) == 0), "{latex}");
                assert_eq!([count("<math"), count("</math>")], [1, 1], "{latex}");
                assert_eq!(count("<mi"), count("</mi>"), "{latex}");
            }
        }
    }
    let message = page(vec![Block::Text(format!("$\\operatorname{{{}}}$", evil[0]))]).render();
    let message = message.unwrap_err().to_string();
    assert!(message.contains("a tag that is not MathML: \"script\""), "{message}");
    assert!(text("$a < b > c \\lt \\operatorname{sign} \\text{a < b}$").contains("&lt;"));
}

#[test]
fn a_power_of_nothing_is_refused_and_a_stray_column_is_no_panic() {
    let set = |latex: &str| {
        let latex = format!("\\begin{{pmatrix}} {latex} \\end{{pmatrix}}");
        page(vec![Block::Equation { latex, label: None }]).render()
    };
    for latex in ["a &^ b", "a &_ b", "a \\\\ ^ b", "a & \\frac{1} & b"] {
        let message = set(latex).unwrap_err().to_string();
        assert!(message.contains("without all its parts"), "{message}");
    }
    for latex in ["a & \\sqrt & b", "a & \\hat & b", "a & \\left( & b", "& & \\\\ &"] {
        let _ = set(latex); // an error is an answer
    }
    assert!(set("a^{2} & \\frac{1}{2} \\\\ \\sum_{i}^{n} & {}^{3}b").is_ok());
}

#[test]
fn formulas_nest_as_deep_as_they_are_long() {
    let nested =
        ["{", "\\hat", "\\sqrt ", "\\frac", "\\left(", "\\color{red}", "\\not ", "√", "x^{", "["];
    for piece in nested {
        for count in [300, 9_900 / piece.len()] {
            let latex = format!("{}x{}", piece.repeat(count), "}".repeat(count));
            // An error is allowed, a panic is not.
            let _ = page(vec![Block::Equation { latex, label: None }]).render();
        }
    }
    let braces = format!("{}x{}", "{".repeat(5000), "}".repeat(5000));
    assert!(text(&format!("${braces}$")).contains("<mi>x</mi>"));
    let long = page(vec![Block::Text(format!("${}$", "x".repeat(30_000)))]).render();
    assert!(long.unwrap_err().to_string().contains("30000 bytes"));
}

#[test]
fn a_bad_equation_is_an_error_that_names_it_and_its_place() {
    let mut page = page(vec![
        Block::Text("good $x$".into()),
        Block::Equation { latex: "\\nonsense x".into(), label: None },
        Block::Text("bad $\\frac{1}$ and".into()),
        Block::Note("open $x".into()),
    ]);
    page.lead = "[run](javascript:alert)".into();
    let message = page.render().unwrap_err().to_string();
    assert!(message.contains("4 defects"), "{message}");
    for part in ["section 1 \"One\", block 2", "nonsense x", "frac{1}", "without a closing"] {
        assert!(message.contains(part), "{part} in {message}");
    }
    assert!(message.contains("lead: the link \"javascript:alert\""), "{message}");
}

#[test]
fn rows_and_anchors_are_checked() {
    let columns = vec![Column::words("a"), Column::words("b")];
    let rows = vec![vec![Cell::text("1")]];
    let mut page = page(vec![Block::Table(Table { columns, rows, ..Table::default() })]);
    page.sections.push(Section { id: "one".into(), ..Section::default() });
    page.sections.push(Section { id: "a b".into(), ..Section::default() });
    let message = page.render().unwrap_err().to_string();
    assert!(message.contains("row 1: has 1 cells, the table 2 columns"), "{message}");
    assert!(message.contains("section 2: its id \"one\" is that of section 1"), "{message}");
    assert!(message.contains("section 3: \"a b\" cannot be an anchor"), "{message}");
}

#[test]
fn a_page_fetches_nothing_and_is_the_same_twice() {
    let (id, title, caption) = ("empty".into(), "Empty".into(), "See $x$.".into());
    let plot = Lines { id, title, caption, x: Axis::linear("t", "s"), panels: Vec::new() };
    let page = page(vec![Block::Figure(Picture::of(&plot, "figures"))]);
    let html = page.render().unwrap();
    assert_eq!(html, page.render().unwrap());
    assert!(html.contains(&plot.svg()) && html.contains("href=\"figures/empty.csv\""));
    assert!(html.contains("<html lang=\"en\">") && html.contains("<main id=\"content\""));
    let outside = html.replace("http://www.w3.org/2000/svg", "");
    for fetch in ["http:", "https:", "src=\"", "@import", "<link rel=\"stylesheet"] {
        assert!(!outside.contains(fetch), "{fetch}");
    }
    assert!(html.len() < 300_000, "{} bytes", html.len());
}

#[test]
fn a_table_shows_short_numbers_and_keeps_full_ones() {
    let table = Table {
        title: "Residuals".into(),
        columns: vec![Column::words("solver"), Column::numbers("residual", "m/s")],
        rows: vec![
            vec![Cell::text("pgs, plain"), Cell::number(1.0 / 3.0, 2)],
            vec![Cell::text("lemke").marked(Mark::Bad), Cell::text("failed")],
        ],
        ..Table::default()
    };
    assert_eq!(
        table.csv(),
        "solver,residual (m/s)\n\"pgs, plain\",0.3333333333333333\nlemke,failed\n"
    );
    let html = main_part(&page(vec![Block::Table(table)]));
    assert!(html.contains("<td class=\"number\" data-value=\"0.3333333333333333\">0.33</td>"));
    assert!(html.contains("<td class=\"bad\">lemke</td>"));
    assert!(html.contains("<a class=\"self\" href=\"#table-1\">Table 1.</a> <b>Residuals.</b>"));
}
