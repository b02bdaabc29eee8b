//! The posterior of the unknowns: the density of each on the diagonal, and of each pair below it.

use planar_impact_app::issue::Issues;
use planar_impact_app::reconstruct::{PairDensity, PosteriorDensity, Reconstruction};
use planar_impact_app::{Answer, Units};
use plotters::prelude::{Color, RGBColor, ShapeStyle};
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Area, BLUE, DARK, Digits, Drawn, VERMILION, Writing, outline, page, px, rectangle, segment, with_unit, write};

/// Number of unknowns that fit the page.
const MOST: usize = 6;
/// Left edge, right edge and upper edge of the panels, and the space between them, in pixels.
const LEFT: i32 = 96;
const RIGHT: i32 = 880;
const TOP: i32 = 26;
const GAP: i32 = 18;
/// Height below the panels, for the numbers, the names and the legend.
const FOOT: i32 = 84;
/// Side of the largest panel.
const LARGEST: i32 = 300;

/// Draws the posterior of the unknowns listed under `[unknown]`, at most six, and of each pair of them; `None` without draws, or if none of them varies.
///
/// # Errors
///
/// A defect: drawing into memory cannot fail.
pub fn posterior(answer: &Answer<Reconstruction>, units: Units) -> Result<Option<String>, Issues> {
    let Some(draws) = &answer.posterior else { return Ok(None) };
    let corner = Corner { of: quantities(answer, units), pairs: &draws.pairs };
    if corner.of.is_empty() {
        return Ok(None);
    }
    let describe = |of: &Quantity<'_>| format!("{}: most likely range {} to {}", of.name, of.hdi[0], of.hdi[1]);
    let description = format!("Posterior densities. {}.", corner.of.iter().map(describe).collect::<Vec<_>>().join("; "));
    let title = if answer.title.is_empty() { "Posterior".to_owned() } else { format!("Posterior: {}", answer.title) };
    page(&title, &description, px(corner.height() as u32), |area| corner.draw(area)).map(Some)
}

/// An unknown with its density, in the units of the reader.
struct Quantity<'a> {
    key: &'a str,
    name: String,
    /// Edges of the bins.
    edges: Vec<f64>,
    density: &'a PosteriorDensity,
    hdi: [f64; 2],
    best: Option<f64>,
}

fn quantities(answer: &Reconstruction, units: Units) -> Vec<Quantity<'_>> {
    let asked = answer.unknown.iter().filter(|(_, unknown)| !unknown.is_input);
    let found = asked.filter_map(|(key, unknown)| {
        let posterior = unknown.posterior.as_ref()?;
        let density = posterior.density.as_ref()?;
        let convert = |si: f64| units.convert(unknown.measure, si);
        Some(Quantity {
            key,
            name: with_unit(key, units.unit(unknown.measure)),
            edges: density.edges.iter().map(|edge| convert(*edge)).collect(),
            density,
            hdi: posterior.hdi.map(convert),
            best: unknown.value.map(convert),
        })
    });
    found.take(MOST).collect()
}

struct Corner<'a> {
    of: Vec<Quantity<'a>>,
    pairs: &'a [PairDensity],
}

impl Corner<'_> {
    /// Returns the side of a panel, in pixels.
    fn side(&self) -> i32 {
        let count = self.of.len() as i32;
        ((RIGHT - LEFT - (count - 1) * GAP) / count).min(LARGEST)
    }

    /// Returns the height of the page, in pixels.
    fn height(&self) -> i32 {
        TOP + self.of.len() as i32 * (self.side() + GAP) - GAP + FOOT
    }

    /// Returns the upper left corner of a panel, by its column and row.
    fn corner(&self, column: usize, row: usize) -> (i32, i32) {
        let step = self.side() + GAP;
        (LEFT + step * column as i32, TOP + step * row as i32)
    }

    fn draw(&self, area: &Area<'_>) -> Drawn {
        let (count, side) = (self.of.len(), self.side());
        for row in 0..count {
            for column in 0..=row {
                let at = self.corner(column, row);
                if column == row {
                    self.density(area, &self.of[row], at)?;
                } else if let Some(pair) = self.pair(column, row) {
                    cells(area, &pair.shares, at, side)?;
                }
                outline(area, at, (at.0 + side, at.1 + side), DARK)?;
                self.best(area, column, row, at)?;
            }
            // Numbers of the rows on the left, but not of the first, which is a density.
            if row > 0 {
                self.ends(area, row, false)?;
            }
        }
        for column in 0..count {
            self.ends(area, column, true)?;
        }
        self.legend(area)
    }

    /// Returns the density of two unknowns by their places; the first has the columns.
    fn pair(&self, column: usize, row: usize) -> Option<&PairDensity> {
        self.pairs.iter().find(|pair| pair.x == self.of[column].key && pair.y == self.of[row].key)
    }

    /// Draws the density of one unknown, with its shortest range.
    fn density(&self, area: &Area<'_>, of: &Quantity<'_>, at: (i32, i32)) -> Drawn {
        let side = self.side();
        let greatest = of.density.shares.iter().copied().fold(0.0, f64::max);
        let count = of.density.shares.len() as i32;
        for (bin, share) in of.density.shares.iter().enumerate() {
            let bin = bin as i32;
            let high = (0.92 * f64::from(side) * share / greatest).round() as i32;
            let (from, to) = (at.0 + side * bin / count, at.0 + side * (bin + 1) / count);
            if high > 0 {
                rectangle(area, (from, at.1 + side - high), (to, at.1 + side), BLUE.mix(0.55).filled())?;
            }
        }
        let across = |value: f64| at.0 + (f64::from(side) * of.share(value)).round() as i32;
        let y = at.1 + side - 6;
        segment(area, (across(of.hdi[0]), y), (across(of.hdi[1]), y), ShapeStyle::from(&DARK).stroke_width(px(3)))
    }

    /// Draws the best fit, where it is within the draws.
    fn best(&self, area: &Area<'_>, column: usize, row: usize, at: (i32, i32)) -> Drawn {
        let (side, style) = (self.side(), ShapeStyle::from(&VERMILION).stroke_width(px(1)));
        let place = |of: usize| self.of[of].best.map(|best| self.of[of].share(best)).filter(|share| (0.0..=1.0).contains(share));
        if let Some(share) = place(column) {
            let x = at.0 + (f64::from(side) * share).round() as i32;
            segment(area, (x, at.1), (x, at.1 + side), style)?;
        }
        if let Some(share) = place(row).filter(|_| column != row) {
            let y = at.1 + side - (f64::from(side) * share).round() as i32;
            segment(area, (at.0, y), (at.0 + side, y), style)?;
        }
        Ok(())
    }

    /// Writes the ends of the scale of an unknown and its name, below its column or beside its row.
    fn ends(&self, area: &Area<'_>, of: usize, is_below: bool) -> Drawn {
        let (quantity, side) = (&self.of[of], self.side());
        let (first, last) = (quantity.edges[0], quantity.edges[quantity.edges.len() - 1]);
        let digits = Digits::of(&(first.min(last)..first.max(last)));
        let [first, last] = [first, last].map(|value| digits.write(value));
        if is_below {
            let (x, y) = self.corner(of, self.of.len() - 1);
            let y = y + side + 6;
            write(area, &first, 13, (x, y))?;
            Writing { size: 13, ..Writing::ending() }.write(area, &last, (x + side, y))?;
            // Names wider than their panel stand in two heights.
            let lines = wrapped(&quantity.name, (side / 7) as usize);
            for (i, line) in lines.iter().enumerate() {
                Writing { size: 13, ..Writing::centered() }.write(area, line, (x + side / 2, y + 17 + 14 * i as i32))?;
            }
        } else {
            let (x, y) = self.corner(0, of);
            Writing { size: 13, ..Writing::ending() }.write(area, &last, (x - 6, y))?;
            Writing { size: 13, across: HPos::Right, down: VPos::Bottom, ..Writing::default() }.write(area, &first, (x - 6, y + side))?;
            let lines = wrapped(&quantity.name, (side / 7) as usize);
            for (i, line) in lines.iter().enumerate() {
                let right = x - 68 + 14 * i as i32 - 7 * (lines.len() as i32 - 1);
                let writing = Writing { size: 13, down: VPos::Center, is_upright: true, ..Writing::centered() };
                writing.write(area, line, (right, y + side / 2))?;
            }
        }
        Ok(())
    }

    /// Says what the marks are, in the empty corner above the pairs, or below a single density.
    fn legend(&self, area: &Area<'_>) -> Drawn {
        let (side, count) = (self.side(), self.of.len());
        let (x, y) = if count > 1 { (LEFT + side + GAP + 10, TOP + 4) } else { (LEFT + side + GAP + 10, TOP + 20) };
        segment(area, (x, y + 8), (x + 30, y + 8), ShapeStyle::from(&VERMILION).stroke_width(px(1)))?;
        write(area, "best fit", 14, (x + 40, y))?;
        segment(area, (x, y + 30), (x + 30, y + 30), ShapeStyle::from(&DARK).stroke_width(px(3)))?;
        write(area, "shortest range of the level", 14, (x + 40, y + 22))?;
        for i in 0..6 {
            rectangle(area, (x + 5 * i, y + 46), (x + 5 * (i + 1), y + 60), shade(f64::from(i + 1) / 6.0).filled())?;
        }
        write(area, "share of the draws, up to the greatest", 14, (x + 40, y + 45))
    }
}

impl Quantity<'_> {
    /// Returns the place of a value between the first and the last edge, which are 0 and 1.
    fn share(&self, value: f64) -> f64 {
        let (first, last) = (self.edges[0], self.edges[self.edges.len() - 1]);
        (value - first) / (last - first)
    }
}

/// Returns a color that darkens with a share of the greatest density, in greyscale too.
fn shade(share: f64) -> RGBColor {
    let mix = |white: f64, full: f64| (white + share.sqrt() * (full - white)).round() as u8;
    RGBColor(mix(255.0, 0.0), mix(255.0, 60.0), mix(255.0, 110.0))
}

/// Draws the cells of a pair, its first row at the bottom.
fn cells(area: &Area<'_>, shares: &[Vec<f64>], at: (i32, i32), side: i32) -> Drawn {
    let greatest = shares.iter().flatten().copied().fold(0.0, f64::max);
    for (row, of_row) in shares.iter().enumerate() {
        for (column, share) in of_row.iter().enumerate().filter(|(_, share)| **share > 0.0) {
            let [from, to] = cell(at, side, [column, row], [of_row.len(), shares.len()]);
            rectangle(area, from, to, shade(share / greatest).filled())?;
        }
    }
    Ok(())
}

/// Returns the upper left and the lower right corner of a cell, by its column and its row from the bottom.
fn cell(at: (i32, i32), side: i32, [column, row]: [usize; 2], [wide, high]: [usize; 2]) -> [(i32, i32); 2] {
    let edge = |place: usize, count: usize| side * place as i32 / count as i32;
    let across = |column: usize| at.0 + edge(column, wide);
    let down = |row: usize| at.1 + side - edge(row, high);
    [(across(column), down(row + 1)), (across(column + 1), down(row))]
}

/// Breaks a dotted name into lines of at most so many characters, where its parts allow it.
fn wrapped(name: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for piece in name.split_inclusive(['.', '_', ' ']) {
        match lines.last_mut() {
            Some(last) if last.is_empty() || last.chars().count() + piece.chars().count() <= most => last.push_str(piece),
            _ => lines.push(piece.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::super::samples::{assert_legible, reconstructed};
    use super::*;
    use planar_impact_app::reconstruct::Options;

    #[test]
    fn cells_tile_their_panel_with_the_first_at_the_lower_left() {
        let of = |column: usize, row: usize| cell((100, 50), 185, [column, row], [24, 24]);
        let ([left, top], [right, bottom]) = ([of(0, 0)[0].0, of(0, 23)[0].1], [of(23, 0)[1].0, of(0, 0)[1].1]);
        assert_eq!([left, top, right, bottom], [100, 50, 285, 235]);
        for (column, row) in [(0, 0), (7, 11), (22, 22)] {
            assert_eq!((of(column, row)[1].0, of(column, row)[0].1), (of(column + 1, row)[0].0, of(column, row + 1)[1].1));
        }
        // Values grow to the right.
        let edges = [10.0, 20.0, 30.0];
        let density = PosteriorDensity { edges: edges.into(), shares: vec![0.5, 0.5] };
        let quantity = Quantity { key: "", name: String::new(), edges: edges.into(), density: &density, hdi: [12.0, 28.0], best: None };
        assert_eq!([10.0, 25.0, 30.0].map(|value| quantity.share(value)), [0.0, 0.75, 1.0]);
    }

    #[test]
    fn margins_of_a_pair_are_the_densities() {
        let options = Options { posterior: true, draws: true, ..Options::default() };
        let answer = reconstructed(include_str!("../../../cli/examples/reconstruct/uncertain-masses.toml"), options);
        let draws = answer.posterior.as_ref().expect("draws");
        let density =
            |name: &str| answer.unknown.get(name).and_then(|unknown| unknown.posterior.as_ref()?.density.as_ref()).expect("a density");
        assert!(!draws.pairs.is_empty());
        for pair in &draws.pairs {
            let (x, y) = (density(&pair.x), density(&pair.y));
            let close = |one: f64, other: f64| assert!((one - other).abs() < 1e-9, "{one}, not {other}");
            for (row, share) in pair.shares.iter().zip(&y.shares) {
                close(row.iter().sum(), *share);
            }
            for (column, share) in x.shares.iter().enumerate() {
                close(pair.shares.iter().map(|row| row[column]).sum(), *share);
            }
            // Each cell counts the draws between its edges.
            let values = draws.values.as_ref().expect("values");
            let [of_x, of_y] = [&pair.x, &pair.y].map(|name| values.get(name).expect("draws"));
            let within = |value: f64, edges: &[f64], bin: usize| edges[bin] <= value && value < edges[bin + 1];
            let (row, column) = (11, 12);
            let count = of_x.iter().zip(of_y).filter(|(u, v)| within(**u, &x.edges, column) && within(**v, &y.edges, row)).count();
            let off = (pair.shares[row][column] * of_x.len() as f64 - count as f64).abs();
            assert!(off <= 2.0, "rounding at an edge at most: {off}");
        }
        for (_, unknown) in answer.unknown.iter() {
            let posterior = unknown.posterior.as_ref().expect("a posterior");
            let Some(density) = &posterior.density else { continue };
            let middle: f64 = density.edges.windows(2).zip(&density.shares).map(|(edges, share)| 0.5 * (edges[0] + edges[1]) * share).sum();
            let width = density.edges[1] - density.edges[0];
            assert!((middle - posterior.mean).abs() < 0.5 * width, "{middle}, not {}", posterior.mean);
            assert!((density.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
        assert_legible(&posterior(&answer, Units::Us).expect("in memory").expect("draws"));
    }

    /// Returns what is drawn after the background and the title, in pixels: rectangles by corner, size and color, lines by width and points, texts by place and size.
    fn drawn(of: Vec<Quantity<'_>>, pairs: &[PairDensity]) -> Vec<String> {
        let corner = Corner { of, pairs };
        let svg = page("t", "d", px(corner.height() as u32), |area| corner.draw(area)).expect("drawn");
        let document = roxmltree::Document::parse(&svg).expect("an SVG");
        let told = |node: roxmltree::Node<'_, '_>| {
            let text = |name: &str| node.attribute(name).unwrap_or_default().to_owned();
            let number = |name: &str| text(name).parse::<f64>().expect("a number") / 8.0;
            match node.tag_name().name() {
                "rect" => Some(format!("{} {} {} {} {}", number("x"), number("y"), number("width"), number("height"), text("fill"))),
                "polyline" => {
                    let points = text("points")
                        .split([' ', ','])
                        .filter(|x| !x.is_empty())
                        .map(|x| (x.parse::<f64>().expect("a number") / 8.0).to_string())
                        .collect::<Vec<_>>();
                    Some(format!("{}: {}", number("stroke-width"), points.join(" ")))
                }
                "text" => {
                    Some(format!("{} {} {:.1} {}", number("x"), number("y"), number("font-size"), node.text().unwrap_or_default().trim()))
                }
                _ => None,
            }
        };
        document.root_element().children().filter_map(told).skip(2).collect()
    }

    /// By hand: panels of 300 pixels from (96, 66), below the title, and 18 between them. Bars are 0.92 of that at the greatest share; a value of 3 from 0 to 4 is at 225.
    #[test]
    fn marks_stand_where_their_numbers_are() {
        let of = |key, edges: &[f64], density, hdi, best| Quantity {
            key,
            name: key.to_owned(),
            edges: edges.to_vec(),
            density,
            hdi,
            best: Some(best),
        };
        let density = |shares: &[f64]| PosteriorDensity { edges: Vec::new(), shares: shares.to_vec() };
        let (of_speed, of_plane) = (density(&[0.25, 0.75]), density(&[0.5, 0.0, 0.5]));
        let speed = || of("speed", &[0.0, 2.0, 4.0], &of_speed, [1.0, 3.0], 3.0);
        let plane = of("plane", &[10.0, 20.0, 30.0, 40.0], &of_plane, [10.0, 25.0], 25.0);
        let pair = PairDensity { x: "speed".into(), y: "plane".into(), shares: vec![vec![0.25, 0.0], vec![0.0, 0.0], vec![0.0, 0.75]] };
        let alone = [
            "96 274 150 92 #0072B2",
            "246 90 150 276 #0072B2",
            "3: 171 360 321 360",
            "1: 96 66 396 66 396 366 96 366 96 66",
            "1: 321 66 321 366",
        ];
        let of_one = drawn(vec![speed()], &[]);
        assert_eq!(of_one[..5], alone);
        // Its legend is beside it.
        assert!(of_one.contains(&"464 86 11.3 best fit".to_owned()), "{of_one:?}");
        // The pair below, lowest values first; the second density; numbers and names beside and below; the legend.
        let both = [
            "96 584 150 100 #6C8EAB",
            "246 384 150 100 #003C6E",
            "1: 96 384 396 384 396 684 96 684 96 384",
            "1: 321 384 321 684",
            "1: 96 534 396 534",
            "414 408 100 276 #0072B2",
            "614 408 100 276 #0072B2",
            "3: 414 678 564 678",
            "1: 414 384 714 384 714 684 414 684 414 384",
            "1: 564 384 564 684",
            "90 384 10.5 40",
            "90 684 10.5 10",
            "28 534 10.5 plane",
            "96 690 10.5 0.0",
            "396 690 10.5 4.0",
            "246 707 10.5 speed",
            "414 690 10.5 10",
            "714 690 10.5 40",
            "564 707 10.5 plane",
            "1: 424 78 454 78",
            "464 70 11.3 best fit",
            "3: 424 100 454 100",
            "464 92 11.3 shortest range of the level",
            "424 116 5 14 #97AFC4",
            "429 116 5 14 #6C8EAB",
            "434 116 5 14 #4B7598",
            "439 116 5 14 #2F6089",
            "444 116 5 14 #164D7B",
            "449 116 5 14 #003C6E",
            "464 115 11.3 share of the draws, up to the greatest",
        ];
        assert_eq!(drawn(vec![speed(), plane], &[pair])[5..], both);
    }

    #[test]
    fn names_break_behind_their_parts() {
        assert_eq!(wrapped("vehicle.1.speed", 20), ["vehicle.1.speed"]);
        assert_eq!(wrapped("vehicle.1.speed", 15), ["vehicle.1.speed"]);
        assert_eq!(wrapped("vehicle.1.speed", 14), ["vehicle.1.", "speed"]);
        assert_eq!(wrapped("contact.impulse_ratio.of_critical", 16), ["contact.impulse_", "ratio.of_", "critical"]);
        // A part alone is not divided.
        assert_eq!(wrapped("restitution", 4), ["restitution"]);
    }
}
