//! Renders documents as one self-contained HTML file: no script, no address outside, made to be read on a screen and printed.

use std::fmt::Write;

use planar_impact_app::notice::Severity;
use planar_impact_app::plain_text::shown;
use pulldown_latex::{Parser, RenderConfig, Storage, config::DisplayMode, push_mathml};
use quick_xml::escape::escape;

use crate::block::{Align, Block, Table};

/// A document of sections.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Its title.
    pub title: String,
    /// What a printed page has at its foot.
    pub foot: String,
    /// Its sections, in order.
    pub sections: Vec<Section>,
    /// Files that are embedded, so that a program can read them again.
    pub embedded: Vec<Embedded>,
}

/// A section of a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The address of the section in the document.
    pub id: &'static str,
    /// Its heading.
    pub heading: String,
    /// Its contents.
    pub blocks: Vec<Block>,
}

/// A file inside a document.
#[derive(Clone, Debug, PartialEq)]
pub struct Embedded {
    /// The address of the file in the document.
    pub id: String,
    /// Its name, where another file names it.
    pub name: Option<String>,
    /// Its type, such as `application/toml`.
    pub media_type: &'static str,
    /// Its text. `&`, `<` and `>` are written as entities, so that nothing in it ends the element.
    pub text: String,
}

/// Renders a document. The same document gives the same bytes.
pub fn render(document: &Document) -> String {
    let title = escape(shown(&document.title)).into_owned();
    let mut html = String::from("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n");
    html.push_str("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    let _ = writeln!(html, "<meta name=\"generator\" content=\"planar-impact {}\">", env!("CARGO_PKG_VERSION"));
    let _ = writeln!(
        html,
        "<title>{title}</title>\n<style>\n{}{}</style>\n</head>\n<body>",
        include_str!("html/style.css"),
        page_style(document)
    );
    let _ = writeln!(html, "<header>\n<h1>{title}</h1>\n</header>");
    html.push_str("<nav aria-label=\"Contents\">\n<ol>\n");
    for section in &document.sections {
        let _ = writeln!(html, "<li><a href=\"#{}\">{}</a></li>", section.id, escape(shown(&section.heading)));
    }
    html.push_str("</ol>\n</nav>\n<main>\n");
    for section in &document.sections {
        let _ = writeln!(
            html,
            "<section id=\"{0}\" aria-labelledby=\"{0}-heading\">\n<h2 id=\"{0}-heading\">{1}</h2>",
            section.id,
            escape(shown(&section.heading))
        );
        blocks(&mut html, &section.blocks);
        html.push_str("</section>\n");
    }
    html.push_str("</main>\n");
    for file in &document.embedded {
        let name = file.name.as_ref().map_or_else(String::new, |name| format!(" data-name=\"{}\"", escape(shown(name))));
        let _ = writeln!(html, "<script type=\"{}\" id=\"{}\"{name}>{}</script>", file.media_type, file.id, entities(&file.text));
    }
    html.push_str("</body>\n</html>\n");
    html
}

/// Renders blocks for a section of a page that has headings of levels 1 and 2 itself. Every text is escaped, and nothing has a style of its own.
pub fn fragment(of: &[Block]) -> String {
    let mut html = String::new();
    blocks(&mut html, of);
    html
}

/// Writes the characters that could end an element as entities, and nothing else.
fn entities(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// What a printed page has above and below.
fn page_style(document: &Document) -> String {
    let (title, foot) = (style_text(&document.title), style_text(&document.foot));
    format!("@page {{ @top-left {{ content: \"{title}\"; }} @bottom-left {{ content: \"{foot}\"; }} }}\n")
}

/// Writes a text inside quotation marks of a style sheet: every character but letters, digits and spaces as its code point, which takes the space after it.
fn style_text(text: &str) -> String {
    let short = planar_impact_app::plain_text::shorten(text, 90);
    short.chars().map(|c| if c.is_ascii_alphanumeric() || c == ' ' { c.to_string() } else { format!("\\{:x} ", u32::from(c)) }).collect()
}

fn blocks(html: &mut String, blocks: &[Block]) {
    // The document and the section have levels 1 and 2; a page may begin below its own title, but no level is left out.
    let (mut in_list, mut above) = (false, Vec::new());
    for block in blocks {
        let is_item = matches!(block, Block::Item { .. });
        if is_item != in_list {
            html.push_str(if is_item { "<ul>\n" } else { "</ul>\n" });
            in_list = is_item;
        }
        match block {
            Block::Heading { level, text } => {
                above.retain(|outer| outer < level);
                above.push(*level);
                let level = (2 + above.len()).min(6);
                let _ = writeln!(html, "<h{level}>{}</h{level}>", escape(shown(text)));
            }
            other => one(html, other),
        }
    }
    if in_list {
        html.push_str("</ul>\n");
    }
}

fn one(html: &mut String, block: &Block) {
    let text_of = |text: &str| escape(shown(text)).into_owned();
    let _ = match block {
        Block::Heading { .. } => Ok(()),
        Block::Paragraph(text) => writeln!(html, "<p>{}</p>", text_of(text)),
        Block::Item { label, text } => match label.trim() {
            "-" | "" => writeln!(html, "<li>{}</li>", text_of(text)),
            label => writeln!(html, "<li class=\"labeled\"><span class=\"mark\">{}</span> {}</li>", text_of(label), text_of(text)),
        },
        Block::Table(of) => {
            table(html, of);
            Ok(())
        }
        Block::Notice { severity, text } => {
            let (class, label) = match severity {
                Severity::Note => ("note", "Note"),
                Severity::Warning => ("warning", "Warning"),
            };
            writeln!(html, "<p class=\"notice {class}\"><strong>{label}:</strong> {}.</p>", text_of(text))
        }
        Block::Verbatim(text) => {
            let lines: Vec<String> = text.lines().map(|line| text_of(line.trim_end())).collect();
            writeln!(html, "<pre tabindex=\"0\">{}</pre>", lines.join("\n"))
        }
        Block::Formula { latex, text } => match mathml(latex) {
            Some(formula) => writeln!(html, "<div class=\"formula\" tabindex=\"0\">{formula}</div>"),
            None => writeln!(html, "<pre tabindex=\"0\">{}</pre>", text_of(text)),
        },
        Block::Figure { title, svg } => writeln!(html, "<figure>\n{}<figcaption>{}</figcaption>\n</figure>", inline(svg), text_of(title)),
    };
}

/// Returns a drawing without what only a file of its own needs.
fn inline(svg: &str) -> &str {
    svg.find("<svg").map_or(svg, |start| &svg[start..])
}

/// Returns a formula as MathML; `None` if it has what the converter does not know.
fn mathml(latex: &str) -> Option<String> {
    let storage = Storage::new();
    let events: Result<Vec<_>, _> = Parser::new(latex, &storage).collect();
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    let mut formula = String::new();
    push_mathml(&mut formula, events.ok()?.into_iter().map(Ok::<_, pulldown_latex::ParserError>), config).ok()?;
    // The converter leaves these two operators as they are.
    Some(formula.replace("><</mo>", ">&lt;</mo>").replace(">></mo>", ">&gt;</mo>"))
}

fn table(html: &mut String, of: &Table) {
    let align = |place: usize| if of.columns[place] == Align::Right { " class=\"number\"" } else { "" };
    html.push_str("<div class=\"table\" tabindex=\"0\">\n<table>\n<thead>\n<tr>");
    for (place, head) in of.header.iter().enumerate() {
        let _ = match head.trim() {
            "" => write!(html, "<td></td>"),
            _ => write!(html, "<th scope=\"col\"{}>{}</th>", align(place), escape(shown(head))),
        };
    }
    html.push_str("</tr>\n</thead>\n<tbody>\n");
    for row in &of.rows {
        html.push_str("<tr>");
        for (place, cell) in row.iter().enumerate() {
            let cell = escape(shown(cell)).into_owned();
            let is_head = place == 0 && of.columns[0] == Align::Left && !cell.trim().is_empty();
            let _ = if is_head { write!(html, "<th scope=\"row\">{cell}</th>") } else { write!(html, "<td{}>{cell}</td>", align(place)) };
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody>\n</table>\n</div>\n");
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(blocks: Vec<Block>) -> String {
        let section = Section { id: "one", heading: "One".to_owned(), blocks };
        render(&Document {
            title: "<i>\u{202e}\"'".to_owned(),
            foot: "a\\b\"</style>".to_owned(),
            sections: vec![section],
            embedded: Vec::new(),
        })
    }

    #[test]
    fn no_text_becomes_an_element() {
        let bad = "</pre></style></script><script>alert(1)</script>\u{1b}";
        let table = Table::new([bad], "l", vec![vec![bad.to_owned()]]);
        let notice = Block::Notice { severity: Severity::Warning, text: bad.to_owned() };
        let blocks = vec![
            Block::paragraph(bad),
            Block::item(bad, bad),
            table.into(),
            Block::Verbatim(bad.to_owned()),
            notice,
            Block::Heading { level: 2, text: bad.to_owned() },
        ];
        let html = of(blocks);
        assert!(!html.contains("<script") && !html.contains("<i>") && html.matches("</style>").count() == 1, "{html}");
        assert!(html.contains("U+001B") && html.contains("U+202E") && !html.contains('\u{202e}'));
    }

    #[test]
    fn an_embedded_file_comes_back() {
        let text = "name = \"</script>&amp;<\" # > \n";
        let document = Document {
            title: String::new(),
            foot: String::new(),
            sections: Vec::new(),
            embedded: vec![Embedded { id: "case".to_owned(), name: None, media_type: "application/toml", text: text.to_owned() }],
        };
        let html = render(&document);
        let start = "<script type=\"application/toml\" id=\"case\">";
        let inside = html.split(start).nth(1).and_then(|rest| rest.split("</script>").next()).expect("embedded");
        assert_eq!(inside.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&"), text);
    }

    #[test]
    fn no_level_of_headings_is_left_out() {
        let heading = |level| Block::Heading { level, text: "x".to_owned() };
        let html = of([3, 3, 2, 3, 1, 9].map(heading).into());
        let levels: String = html.split("</h").filter_map(|rest| rest.chars().next().filter(char::is_ascii_digit)).collect();
        assert_eq!(levels, "12333434", "{html}");
    }

    #[test]
    fn items_are_a_list_and_numbers_are_aligned() {
        let table = Table::new(["", "value"], "lr", vec![vec!["x".to_owned(), "1".to_owned()]]);
        let html = of(vec![Block::item("- ", "a"), Block::item("[1] ", "b"), Block::paragraph("c"), table.into()]);
        assert!(html.contains("<ul>\n<li>a</li>\n<li class=\"labeled\"><span class=\"mark\">[1]</span> b</li>\n</ul>\n<p>c</p>"), "{html}");
        assert!(
            html.contains("<th scope=\"row\">x</th><td class=\"number\">1</td>")
                && html.contains("<td></td><th scope=\"col\" class=\"number\">value</th>")
        );
    }

    #[test]
    fn a_style_sheet_has_texts_as_code_points() {
        assert_eq!(style_text("a, b\"; é"), r"a\2c  b\22 \3b  \e9 ");
    }

    #[test]
    fn formulas_are_mathml() {
        let formula = Block::Formula {
            latex: r"\begin{aligned} \mu_0 &= \frac{K_{nt}}{\Delta v}, \\ x' &= \left( a \right)^{2} \end{aligned}".to_owned(),
            text: "plain".to_owned(),
        };
        let html = of(vec![formula]);
        assert!(html.contains("<math") && html.contains("<mfrac") && !html.contains("plain"), "{html}");
        let less = Block::Formula { latex: "a < b > c".to_owned(), text: String::new() };
        let html = of(vec![less]);
        assert!(html.contains("&lt;</mo>") && html.contains("&gt;</mo>") && !html.contains("><<"), "{html}");
        let unknown = Block::Formula { latex: r"\nosuch{".to_owned(), text: "plain".to_owned() };
        assert!(of(vec![unknown]).contains("<pre tabindex=\"0\">plain</pre>"));
    }
}
