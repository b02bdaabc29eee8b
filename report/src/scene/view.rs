//! From the ground to the page.

use crate::svg::{INK, Place, Svg, number, text_width};

use planar_impact_app::units::{Measure, Units};

use super::{SMALL, border};

/// A rectangle on the page, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub x: f64,
    pub y: f64,
    pub width: f64,
    pub height: f64,
}

impl Frame {
    /// Returns `true` if another rectangle lies inside.
    pub fn contains(&self, other: &Frame) -> bool {
        other.x >= self.x
            && other.y >= self.y
            && other.x + other.width <= self.x + self.width
            && other.y + other.height <= self.y + self.height
    }

    /// Returns `true` if the rectangles overlap.
    pub fn overlaps(&self, other: &Frame) -> bool {
        self.x < other.x + other.width && other.x < self.x + self.width && self.y < other.y + other.height && other.y < self.y + self.height
    }

    /// Draws the frame.
    pub fn draw(&self, svg: &mut Svg) {
        let numbers = [self.x, self.y, self.width, self.height].map(number);
        let mut all = vec![("x", &*numbers[0]), ("y", &*numbers[1]), ("width", &*numbers[2]), ("height", &*numbers[3])];
        all.extend(border());
        svg.element("rect", &all);
    }
}

/// The ground in a frame: x to the right, y up, the same scale for both.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub frame: Frame,
    /// Pixels of a meter.
    pub scale: f64,
    /// The point of the ground in the middle of the frame.
    middle: [f64; 2],
}

impl View {
    /// Returns the view that shows every point, with room around them in pixels. Lengths beyond what floats can scale show nothing.
    pub fn of(points: impl Iterator<Item = [f64; 2]>, frame: Frame, room: f64) -> View {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points.filter(|point| point.iter().all(|x| x.is_finite())) {
            low = [low[0].min(point[0]), low[1].min(point[1])];
            high = [high[0].max(point[0]), high[1].max(point[1])];
        }
        if low[0] > high[0] {
            (low, high) = ([-1.0; 2], [1.0; 2]);
        }
        let size = |k: usize| (high[k] - low[k]).max(1e-9);
        let scale = ((frame.width - 2.0 * room) / size(0)).min((frame.height - 2.0 * room) / size(1)).min(400.0);
        View { frame, scale, middle: [0, 1].map(|k| low[k] / 2.0 + high[k] / 2.0) }
    }

    /// Returns the view that shows every point, and arrows that begin at some of them with a length on the page: pixels to the right and up.
    ///
    /// Two of the arrows, one behind the other, must be shorter than the frame without the room.
    pub fn with_arrows(points: &[[f64; 2]], arrows: &[([f64; 2], [f64; 2])], frame: Frame, room: f64) -> View {
        let still = points.iter().map(|point| (*point, [0.0; 2]));
        let ends: Vec<_> = still.chain(arrows.iter().copied()).filter(|(point, _)| point.iter().all(|x| x.is_finite())).collect();
        let mut scale = View::of(points.iter().copied(), frame, room).scale;
        for (k, size) in [frame.width, frame.height].into_iter().enumerate() {
            for (low, back) in &ends {
                for (high, ahead) in &ends {
                    let (apart, left) = (high[k] - low[k], size - 2.0 * room + back[k].min(0.0) - ahead[k].max(0.0));
                    scale = if apart > 0.0 { scale.min(left / apart) } else { scale };
                }
            }
        }
        let tips = ends.iter().map(|(point, by)| [point[0] + by[0] / scale, point[1] + by[1] / scale]);
        View { scale, ..View::of(ends.iter().map(|(point, _)| *point).chain(tips), frame, room) }
    }

    /// Returns the place of the origin of the ground.
    pub fn origin(&self) -> Place {
        self.place([0.0, 0.0])
    }

    /// Returns the place of a point of the ground.
    pub fn place(&self, [x, y]: [f64; 2]) -> Place {
        let Frame { x: left, y: top, width, height } = self.frame;
        (left + width / 2.0 + self.scale * (x - self.middle[0]), top + height / 2.0 - self.scale * (y - self.middle[1]))
    }

    /// Draws a scale bar in the lower left corner and the axes in the lower right. Returns what they cover.
    pub fn bar(&self, svg: &mut Svg, units: Units) -> Vec<Frame> {
        let meters = 1.0 / units.convert(Measure::Length, 1.0);
        let most = 0.3 * self.frame.width / self.scale / meters;
        let power = libm::exp10(libm::log10(most).floor());
        let length = [5.0, 2.0, 1.0].into_iter().map(|digit| digit * power).find(|length| *length <= most).unwrap_or(power);
        let text = format!("{} {}", number(length), units.unit(Measure::Length));
        let (x, y) = (self.frame.x + 12.0, self.frame.y + self.frame.height - 14.0);
        let end = x + length * meters * self.scale;
        svg.group(&[("class", "scale-bar"), ("stroke", INK), ("stroke-width", "2")], |svg| {
            svg.line((x, y), (end, y), &[]);
            svg.line((x, y - 4.0), (x, y + 4.0), &[]);
            svg.line((end, y - 4.0), (end, y + 4.0), &[]);
        });
        svg.text((x + 4.0, y - 7.0), SMALL, "label", &text);
        let corner = (self.frame.x + self.frame.width - 40.0, self.frame.y + self.frame.height - 14.0);
        svg.group(&[("class", "axes"), ("stroke", INK), ("stroke-width", "1.2"), ("fill", INK)], |svg| {
            arrow_head(svg, corner, (corner.0 + 24.0, corner.1), 6.0, &[]);
            svg.line(corner, (corner.0 + 20.0, corner.1), &[]);
            arrow_head(svg, corner, (corner.0, corner.1 - 24.0), 6.0, &[]);
            svg.line(corner, (corner.0, corner.1 - 20.0), &[]);
        });
        svg.text((corner.0 + 26.0, corner.1 + 4.0), SMALL, "label", "x");
        svg.text((corner.0 - 12.0, corner.1 - 18.0), SMALL, "label", "y");
        let bar = Frame { x, y: y - 22.0, width: (end - x).max(text_width(&text, SMALL) + 4.0), height: 30.0 };
        vec![bar, Frame { x: corner.0 - 16.0, y: corner.1 - 34.0, width: 56.0, height: 48.0 }]
    }
}

/// Draws the head of an arrow at its tip.
pub fn arrow_head(svg: &mut Svg, from: Place, tip: Place, size: f64, attributes: &[(&str, &str)]) {
    let (dx, dy) = (tip.0 - from.0, tip.1 - from.1);
    let length = libm::hypot(dx, dy);
    if length <= 0.0 || !length.is_finite() {
        return;
    }
    let (ux, uy) = (dx / length, dy / length);
    let back = (tip.0 - size * 1.6 * ux, tip.1 - size * 1.6 * uy);
    let side = |sign: f64| (back.0 - sign * size * 0.6 * uy, back.1 + sign * size * 0.6 * ux);
    svg.points("polygon", &[tip, side(1.0), side(-1.0)], attributes);
}
