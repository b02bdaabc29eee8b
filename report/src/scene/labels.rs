//! Places labels where they cover neither each other nor, if that can be, the lines of a picture.

use super::TEXT;
use super::view::Frame;
use crate::svg::{INK, Place, Svg, number, text_width};

/// Distances from what a label names, in pixels.
const DISTANCES: [f64; 9] = [10.0, 18.0, 28.0, 42.0, 60.0, 84.0, 116.0, 160.0, 220.0];
const DIRECTIONS: usize = 24;
/// What it costs to cover a line, in pixels of distance, and one so thick that a label on it cannot be read: any other place is better.
const COVERED: f64 = 36.0;
const STRUCK_OUT: f64 = 1000.0;
/// What it costs to stand away from what is named, in pixels of distance.
const ANYWHERE: f64 = 300.0;
/// The distance beyond which a thin line leads from a label to what it names.
const LEADER: f64 = 30.0;

/// A label, and what it names.
struct Wanted {
    text: String,
    class: String,
    at: Place,
}

/// The labels of a picture.
pub struct Labels {
    frame: Frame,
    taken: Vec<Frame>,
    /// Lines, with what it costs to cover them.
    lines: Vec<(Place, Place, f64)>,
    wanted: Vec<Wanted>,
}

impl Labels {
    pub fn in_frame(frame: Frame) -> Labels {
        Labels { frame, taken: Vec::new(), lines: Vec::new(), wanted: Vec::new() }
    }

    /// Keeps labels out of a rectangle.
    pub fn keep_clear(&mut self, frame: Frame) {
        self.taken.push(frame);
    }

    /// Notes a line that labels should not cover.
    pub fn avoid(&mut self, from: Place, to: Place) {
        self.lines.push((from, to, COVERED));
    }

    /// Notes a thick line, on which a label cannot be read.
    pub fn avoid_thick(&mut self, from: Place, to: Place) {
        self.lines.push((from, to, STRUCK_OUT));
    }

    /// Asks for a label beside a place.
    pub fn want(&mut self, at: Place, class: &str, text: String) {
        self.wanted.push(Wanted { text, class: class.to_owned(), at });
    }

    /// Places and draws all labels, the earliest first.
    pub fn draw(mut self, svg: &mut Svg) {
        for wanted in std::mem::take(&mut self.wanted) {
            let (width, height) = (text_width(&wanted.text, TEXT), TEXT + 4.0);
            let Some((frame, distance)) = self.best(&wanted, width, height) else { continue };
            let middle = (frame.x + frame.width / 2.0, frame.y + frame.height / 2.0);
            if distance > LEADER {
                let near =
                    (middle.0.clamp(frame.x, frame.x + frame.width), if wanted.at.1 > middle.1 { frame.y + frame.height } else { frame.y });
                svg.line(near, wanted.at, &[("class", "leader"), ("stroke", "#707070"), ("stroke-width", "0.8")]);
            }
            let x = number(middle.0);
            let y = number(frame.y + frame.height - 5.0);
            let size = number(TEXT);
            let class = format!("label {}", wanted.class);
            svg.element_with(
                "text",
                &[
                    ("class", &class),
                    ("x", &x),
                    ("y", &y),
                    ("font-size", &size),
                    ("text-anchor", "middle"),
                    ("fill", INK),
                    ("stroke", "#ffffff"),
                    ("stroke-width", "3"),
                    ("paint-order", "stroke"),
                ],
                &wanted.text,
            );
            self.taken.push(frame);
        }
    }

    /// Returns the cheapest free rectangle, and its distance from what it names.
    fn best(&self, wanted: &Wanted, width: f64, height: f64) -> Option<(Frame, f64)> {
        let mut best: Option<(f64, Frame, f64)> = None;
        let consider = |best: &mut Option<(f64, Frame, f64)>, frame: Frame, distance: f64| {
            let least = best.map_or(f64::INFINITY, |(least, ..)| least);
            if distance >= least || !self.frame.contains(&frame) || self.taken.iter().any(|taken| taken.overlaps(&frame)) {
                return;
            }
            let middle = (frame.x + frame.width / 2.0, frame.y + frame.height / 2.0);
            let is_led_across = distance > LEADER && self.taken.iter().any(|taken| crosses(taken, middle, wanted.at));
            let mut cost = distance + if is_led_across { ANYWHERE } else { 0.0 };
            for (from, to, covered) in &self.lines {
                if cost >= least {
                    return;
                }
                cost += if crosses(&frame, *from, *to) { *covered } else { 0.0 };
            }
            if cost < least {
                *best = Some((cost, frame, distance));
            }
        };
        for distance in DISTANCES {
            if best.is_some_and(|(least, ..)| least <= distance) {
                break;
            }
            for direction in 0..DIRECTIONS {
                let angle = std::f64::consts::TAU * direction as f64 / DIRECTIONS as f64;
                let (sin, cos) = libm::sincos(angle);
                let x = wanted.at.0 + cos * (distance + width / 2.0) - width / 2.0;
                let y = wanted.at.1 + sin * (distance + height / 2.0) - height / 2.0;
                consider(&mut best, Frame { x, y, width, height }, distance);
            }
        }
        if best.is_none_or(|(least, ..)| least > ANYWHERE) {
            for row in 0..(self.frame.height / height) as usize {
                for column in 0..8 {
                    let x = self.frame.x + (self.frame.width - width) * f64::from(column) / 7.0;
                    let y = self.frame.y + row as f64 * height;
                    consider(&mut best, Frame { x, y, width, height }, ANYWHERE + libm::hypot(x - wanted.at.0, y - wanted.at.1));
                }
            }
        }
        best.map(|(_, frame, distance)| (frame, distance))
    }
}

/// Returns `true` if a line passes through a rectangle.
fn crosses(frame: &Frame, from: Place, to: Place) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (start, step, low, high) in
        [(from.0, to.0 - from.0, frame.x, frame.x + frame.width), (from.1, to.1 - from.1, frame.y, frame.y + frame.height)]
    {
        if step.abs() < 1e-12 {
            if start < low || start > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - start) / step, (high - start) / step);
        let (first, last) = if a < b { (a, b) } else { (b, a) };
        // Comparisons: on WebAssembly the functions of the least and the greatest number are calls.
        enter = if first > enter { first } else { enter };
        leave = if last < leave { last } else { leave };
    }
    enter <= leave
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_through_a_corner_crosses() {
        let frame = Frame { x: 0.0, y: 0.0, width: 10.0, height: 10.0 };
        assert!(
            crosses(&frame, (-5.0, 5.0), (15.0, 5.0))
                && crosses(&frame, (2.0, 2.0), (3.0, 3.0))
                && crosses(&frame, (5.0, -1.0), (5.0, 1.0))
        );
        assert!(
            !crosses(&frame, (-5.0, 11.0), (15.0, 11.0))
                && !crosses(&frame, (-5.0, 0.0), (0.0, 15.0))
                && !crosses(&frame, (20.0, 5.0), (30.0, 5.0))
        );
    }

    /// Alone, a label has its near edge at the least distance; where that is taken, at the next that is free.
    #[test]
    fn a_label_stands_beside_what_it_names() {
        let frame = Frame { x: 0.0, y: 0.0, width: 400.0, height: 300.0 };
        let wanted = Wanted { text: "label".to_owned(), class: "test".to_owned(), at: (200.0, 150.0) };
        let gap = |frame: &Frame, (x, y): Place| {
            let off = |at: f64, low: f64, size: f64| (low - at).max(at - low - size).max(0.0);
            libm::hypot(off(x, frame.x, frame.width), off(y, frame.y, frame.height))
        };
        let mut labels = Labels::in_frame(frame);
        let (alone, distance) = labels.best(&wanted, 60.0, 16.0).expect("the frame is free");
        assert_eq!((distance, gap(&alone, wanted.at), alone.y + 8.0), (10.0, 10.0, 150.0));
        labels.keep_clear(Frame { x: 185.0, y: 135.0, width: 30.0, height: 30.0 });
        let (beside, distance) = labels.best(&wanted, 60.0, 16.0).expect("the frame is free");
        assert_eq!((distance, gap(&beside, wanted.at)), (18.0, 18.0));
    }

    /// Where everything near is taken, a label stands in the free place of the frame that is nearest.
    #[test]
    fn a_label_without_room_beside_stands_where_the_frame_is_free() {
        let mut labels = Labels::in_frame(Frame { x: 100.0, y: 50.0, width: 800.0, height: 200.0 });
        let wanted = Wanted { text: "label".to_owned(), class: "test".to_owned(), at: (500.0, 150.0) };
        labels.keep_clear(Frame { x: 100.0, y: 50.0, width: 700.0, height: 200.0 });
        // Eight columns, of which the last alone is free; rows of 16 from the top.
        let (free, _) = labels.best(&wanted, 60.0, 16.0).expect("the right end is free");
        assert_eq!((free.x, free.y), (840.0, 146.0));
    }

    /// Farther off is better than on a thick line, and on a thin one better than farther off.
    #[test]
    fn a_thick_line_is_not_written_over() {
        let frame = Frame { x: 0.0, y: 100.0, width: 400.0, height: 100.0 };
        let wanted = Wanted { text: "label".to_owned(), class: "test".to_owned(), at: (200.0, 150.0) };
        let beside = |note: fn(&mut Labels, Place, Place)| {
            let mut labels = Labels::in_frame(frame);
            for y in [105.0, 120.0, 135.0, 150.0, 165.0, 180.0, 195.0] {
                note(&mut labels, (120.0, y), (280.0, y));
            }
            labels.best(&wanted, 60.0, 16.0).expect("the frame is free").1
        };
        let (thin, thick) = (beside(Labels::avoid), beside(Labels::avoid_thick));
        assert!(thin < 30.0 && thick > 80.0, "{thin} {thick}");
    }

    #[test]
    fn labels_of_one_place_do_not_overlap() {
        let frame = Frame { x: 0.0, y: 0.0, width: 400.0, height: 300.0 };
        let mut labels = Labels::in_frame(frame);
        for number in 0..20 {
            labels.want((200.0, 150.0), "test", format!("label number {number}"));
        }
        let mut svg = Svg::new(400.0, 300.0, "", "");
        labels.draw(&mut svg);
        assert_eq!(svg.finish().matches("<text").count(), 20);
    }
}
