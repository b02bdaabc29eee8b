//! Places the values of contour lines where they do not overlap.

use std::ops::Range as Span;

use plotters::prelude::{Color, Rectangle, WHITE};
use plotters::style::text_anchor::VPos;

use super::canvas::{Area, Chart, Drawn, Writing, px};

/// Font size of a label, and width of one character, in pixels.
const LETTERS: u32 = 16;
const LETTER: (i32, i32) = (8, 16);
/// Minimum length in pixels of another line of a level that gets its own label.
const LONG: i32 = 160;

/// A line through the grid, in units of cells: (1.5, 0) is halfway between the second and the third column, in the first row.
pub type Line = Vec<(f64, f64)>;

/// A function that returns `true` if a position, given as fractions of the width and the height, is refused.
type Refused<'a> = dyn Fn(f64, f64) -> bool + 'a;

/// Labels that do not overlap.
#[derive(Default)]
pub struct Labels {
    placed: Vec<Label>,
}

/// A label and the pixels that it covers.
struct Label {
    x: Span<i32>,
    y: Span<i32>,
    text: String,
}

impl Labels {
    /// Labels the longest line of a level, and any others that are long.
    pub fn of(
        &mut self,
        chart: &Chart<'_, '_>,
        lines: &[Line],
        place: &dyn Fn((f64, f64)) -> (f64, f64),
        is_refused: &Refused<'_>,
        text: &str,
    ) {
        let pixels = |line: &Line| -> Vec<(i32, i32)> { line.iter().map(|&point| chart.backend_coord(&place(point))).collect() };
        let mut lines: Vec<Vec<(i32, i32)>> = lines.iter().map(pixels).collect();
        lines.sort_by_key(|line| std::cmp::Reverse(length(line)));
        for (i, line) in lines.iter().enumerate() {
            if i == 0 || length(line) > LONG * px(1) as i32 {
                self.find(chart, line, is_refused, text);
            }
        }
    }

    /// Keeps labels away from a mark of a chart, with its radius in pixels.
    pub fn reserve(&mut self, chart: &Chart<'_, '_>, at: (f64, f64), radius: u32) {
        let ((x, y), radius) = (chart.backend_coord(&at), px(radius) as i32);
        self.placed.push(Label { x: x - radius..x + radius, y: y - radius..y + radius, text: String::new() });
    }

    /// Labels a line through points of a chart.
    pub fn along(&mut self, chart: &Chart<'_, '_>, line: Line, text: &str) {
        self.of(chart, &[line], &|point| point, &|_, _| false, text);
    }

    /// Finds the position on a line that is farthest from existing labels and from the frame, and outside refused points.
    fn find(&mut self, chart: &Chart<'_, '_>, line: &[(i32, i32)], is_refused: &Refused<'_>, text: &str) {
        let (across, down) = chart.plotting_area().get_pixel_range();
        let fine = px(1) as i32;
        let half = (fine * (text.chars().count() as i32 * LETTER.0 / 2 + 2), fine * LETTER.1 / 2);
        let mut best: Option<(i32, (i32, i32))> = None;
        for &at in line {
            let inside = [at.0 - across.start, across.end - at.0].map(|room| room - half.0);
            let inside = inside.into_iter().chain([at.1 - down.start, down.end - at.1].map(|room| room - half.1));
            let mut room = inside.min().unwrap_or(0).min(40 * fine);
            for Label { x, y, .. } in &self.placed {
                let apart = (x.start - at.0 - half.0).max(at.0 - half.0 - x.end).max(y.start - at.1 - half.1).max(at.1 - half.1 - y.end);
                room = room.min(apart);
            }
            let share = |at: i32, frame: &Span<i32>| f64::from(at - frame.start) / f64::from(frame.end - frame.start);
            // Pixel coordinates increase downwards.
            let refused = |x: i32, y: i32| is_refused(share(x, &across), 1.0 - share(y, &down));
            if [-1, 0, 1].iter().any(|i| [-1, 0, 1].iter().any(|j| refused(at.0 + i * half.0, at.1 + j * half.1))) {
                room = room.min(1);
            }
            if room > 0 && best.is_none_or(|(most, _)| room > most) {
                best = Some((room, at));
            }
        }
        if let Some((_, at)) = best {
            self.placed.push(Label { x: at.0 - half.0..at.0 + half.0, y: at.1 - half.1..at.1 + half.1, text: text.to_owned() });
        }
    }

    /// Draws the labels over the lines, each on a white background.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let ((left, top), fine) = (area.get_base_pixel(), px(1) as i32);
        for Label { x, y, text } in self.placed.iter().filter(|label| !label.text.is_empty()) {
            let (x, y) = (x.start - left..x.end - left, y.start - top..y.end - top);
            area.draw(&Rectangle::new([(x.start, y.start), (x.end, y.end)], WHITE.filled()))?;
            let middle = ((x.start + x.end) / 2 / fine, (y.start + y.end) / 2 / fine);
            Writing { size: LETTERS, down: VPos::Center, ..Writing::centered() }.write(area, text, middle)?;
        }
        Ok(())
    }
}

fn length(line: &[(i32, i32)]) -> i32 {
    line.windows(2).map(|pair| (pair[1].0 - pair[0].0).abs() + (pair[1].1 - pair[0].1).abs()).sum()
}

#[cfg(test)]
mod tests {
    use plotters::prelude::ChartBuilder;

    use super::super::canvas::page;
    use super::*;

    /// Forty pixels to the frame, to a mark and to another label are enough; of places with as much room the first is taken.
    #[test]
    fn a_label_lies_where_there_is_most_room() {
        let line = |high: f64| -> Line { (0..=200).map(|i| (f64::from(i) / 200.0, high)).collect() };
        let drawn = page("", "", px(400), |area| {
            let chart = ChartBuilder::on(area).build_cartesian_2d(0.0..1.0, 0.0..1.0)?;
            let mut labels = Labels::default();
            labels.reserve(&chart, (0.0, 0.5), 5);
            labels.along(&chart, line(0.5), "12");
            labels.along(&chart, line(0.5), "34");
            let (across, down) = chart.plotting_area().get_pixel_range();
            let [_, first, second] = &labels.placed[..] else { panic!("a mark and two labels") };
            let room = |label: &Label| {
                [label.x.start - across.start, across.end - label.x.end, label.y.start - down.start, down.end - label.y.end]
            };
            for label in [first, second] {
                assert!(room(label).iter().all(|room| *room >= 40 * px(1) as i32 - 1), "{:?}", room(label));
            }
            assert!(second.x.start - first.x.end >= 40 * px(1) as i32 - 1, "{:?} {:?}", first.x, second.x);
            Ok(())
        });
        assert!(drawn.is_ok());
    }
}
