//! Case files to begin with: one for each kind of collision, with every optional key as a comment.

/// The kind of collision and the text of each template.
const TEMPLATES: [(&str, &str); 6] = [
    ("t-bone", include_str!("../templates/t-bone.toml")),
    ("head-on", include_str!("../templates/head-on.toml")),
    ("rear-end", include_str!("../templates/rear-end.toml")),
    ("barrier", include_str!("../templates/barrier.toml")),
    ("momentum", include_str!("../templates/momentum.toml")),
    ("rest", include_str!("../templates/rest.toml")),
];

/// Returns the kinds of collision that have a template.
pub fn kinds() -> [&'static str; TEMPLATES.len()] {
    TEMPLATES.map(|(kind, _)| kind)
}

/// Returns the case file of a kind; `None` for any other name.
///
/// ```
/// let text = planar_impact_app::template::of("barrier").expect("a kind");
/// assert!(text.starts_with("#:schema ") && text.contains("barrier = true"));
/// ```
pub fn of(kind: &str) -> Option<&'static str> {
    TEMPLATES.iter().find(|(known, _)| *known == kind).map(|(_, text)| *text)
}
