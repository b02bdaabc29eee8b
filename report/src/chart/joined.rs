//! Fewer elements of a chart: plotters writes each dash of a line as an element of its own, which a browser lays out one by one.

use std::fmt::Write;

/// Fewest neighbors that are joined: a broken line has more, while whiskers and curves remain elements of their own.
const FEWEST: usize = 8;

/// Returns a chart in which neighboring lines of one style, such as the dashes of a broken line, are one path. What it shows is the same.
pub fn joined(chart: &str) -> String {
    let lines: Vec<&str> = chart.split_inclusive('\n').collect();
    let mut joined = String::with_capacity(chart.len());
    for run in lines.chunk_by(|one, other| style(one).is_some() && style(one) == style(other)) {
        match style(run[0]) {
            Some(style) if run.len() >= FEWEST => {
                let parts: Vec<&str> = run.iter().filter_map(|line| polyline(line)).map(|(_, points)| points).collect();
                let _ = writeln!(joined, "<path{style}d=\"M{}\"/>", parts.join("M"));
            }
            _ => joined.extend(run.iter().copied()),
        }
    }
    joined
}

/// Returns the style of a line.
fn style(line: &str) -> Option<&str> {
    polyline(line).map(|(style, _)| style)
}

/// Returns style and points of a line that hides what is below it; where one can be seen through, a crossing shows both.
fn polyline(line: &str) -> Option<(&str, &str)> {
    let (style, rest) = line.strip_prefix("<polyline")?.split_once("points=\"")?;
    let points = rest.strip_suffix(" \"/>\n")?;
    style.contains(" opacity=\"1\"").then_some((style, points))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_broken_line_is_one_path() {
        let dash = |opacity: &str, stroke: &str, from: usize| {
            format!(
                "<polyline fill=\"none\" opacity=\"{opacity}\" stroke=\"{stroke}\" stroke-width=\"8\" points=\"{from},1 {},1 \"/>\n",
                from + 5
            )
        };
        let dashes = |opacity: &str, stroke: &str, count: usize| (0..count).map(|i| dash(opacity, stroke, 10 * i)).collect::<String>();
        let text = "<text x=\"1\">\n1\n</text>\n";
        let (few, other) = (dashes("1", "a", FEWEST - 1), dashes("1", "b", 3));
        let chart = format!("<svg>\n{}{other}{text}{few}</svg>\n", dashes("1", "a", FEWEST));
        let path = "M0,1 5,1M10,1 15,1M20,1 25,1M30,1 35,1M40,1 45,1M50,1 55,1M60,1 65,1M70,1 75,1";
        let expected =
            format!("<svg>\n<path fill=\"none\" opacity=\"1\" stroke=\"a\" stroke-width=\"8\" d=\"{path}\"/>\n{other}{text}{few}</svg>\n");
        assert_eq!(joined(&chart), expected);
        // Where lines can be seen through, a crossing of two shows both.
        let seen_through = dashes("0.5", "a", 2 * FEWEST);
        assert_eq!(joined(&seen_through), seen_through);
    }
}
