//! The ground: its friction and grade, and regions with others.
//!
//! A grade is the height gained over a horizontal distance. Lengths are those of a plan, and loads those of level ground: the ground then pushes each wheel by
//! its load times the grade, downhill. The work of that push is exactly the weight times the height, so that speeds are those along the road, as in
//! [`skid`](crate::skid); a time is short by √(1 + G²), 0.1 % on a grade of 5 %.

use alloc::vec::Vec;

use crate::frame::Xy;
use crate::scalar::Real;

/// The ground that a vehicle slides on.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground<T = f64> {
    /// The coefficient of friction between tires and ground outside of the regions, dimensionless.
    pub friction: T,
    /// The grade outside of the regions: the height gained over a horizontal distance along x and along y, dimensionless.
    pub grade: Xy<T>,
    /// Regions with their own friction and grade. If several overlap, the last of them applies.
    pub regions: Vec<Region<T>>,
    /// The length over which a wheel passes from one friction to the other, half of it on each side of the border, in m: that of the tire's contact patch.
    pub contact_length: T,
    /// The acceleration of gravity, in m/s².
    pub gravity: T,
}

/// A part of the ground with its own friction and grade.
#[derive(Clone, Debug, PartialEq)]
pub struct Region<T = f64> {
    /// Its coefficient of friction, dimensionless.
    pub friction: T,
    /// Its grade along x and along y, dimensionless; zero if it is level.
    pub grade: Xy<T>,
    /// Its area.
    pub area: Area<T>,
}

/// Friction and grade under a wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<T = f64> {
    /// The coefficient of friction, dimensionless.
    pub friction: T,
    /// The grade along x and along y, dimensionless.
    pub grade: Xy<T>,
}

/// A part of the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Area<T = f64> {
    /// A half-plane that begins at a border and extends in a direction.
    HalfPlane {
        /// A point of the border, in m.
        from: Xy<T>,
        /// Direction perpendicular to the border, into the region; of any length.
        toward: Xy<T>,
    },
    /// The inside of a polygon in either orientation, its corners in m; empty with fewer than three corners. If its sides cross, the points that they enclose
    /// an odd number of times are inside.
    Polygon(Vec<Xy<T>>),
}

impl Area {
    /// Returns `true` if it has an inside: a half-plane with a direction, or at least three corners that do not all lie on a line.
    pub fn has_inside(&self) -> bool {
        match self {
            Area::HalfPlane { toward, .. } => toward.length() != 0.0,
            Area::Polygon(corners) => {
                let from = |corner: &Xy| *corner - corners[0];
                corners.len() >= 3 && corners.windows(2).any(|pair| from(&pair[0]).cross(from(&pair[1])) != 0.0)
            }
        }
    }

    /// Returns `true` unless sides of a polygon cross each other, as they do where its corners are not in their order along its border.
    ///
    /// ```
    /// use planar_impact::Xy;
    /// use planar_impact::post_impact::Area;
    ///
    /// let polygon = |corners: [[f64; 2]; 4]| Area::Polygon(corners.map(|[x, y]| Xy { x, y }).to_vec());
    /// assert!(polygon([[0.0, 0.0], [20.0, 0.0], [20.0, 20.0], [0.0, 20.0]]).is_simple());
    /// assert!(!polygon([[0.0, 0.0], [20.0, 20.0], [20.0, 0.0], [0.0, 20.0]]).is_simple());
    /// ```
    pub fn is_simple(&self) -> bool {
        let Area::Polygon(corners) = self else { return true };
        let sides: Vec<_> = sides(corners).collect();
        let parts = |(a, b): &(&Xy, &Xy), of: &(&Xy, &Xy)| {
            let side = |point: &Xy| (**b - **a).cross(*point - **a);
            side(of.0) * side(of.1) < 0.0
        };
        let cross = |(i, one)| sides[i + 1..].iter().any(|other| parts(one, other) && parts(other, one));
        !sides.iter().enumerate().any(cross)
    }
}

impl Ground {
    /// Creates level ground with the same friction everywhere.
    pub const fn uniform(friction: f64) -> Ground {
        Ground { friction, grade: Xy { x: 0.0, y: 0.0 }, regions: Vec::new(), contact_length: 0.2, gravity: crate::STANDARD_GRAVITY }
    }

    /// Returns the distance of a point from the nearest border of a region, in m; infinite without regions.
    pub(super) fn distance_to_border(&self, point: &Xy) -> f64 {
        let distance = |region: &Region| match &region.area {
            Area::HalfPlane { from, toward } => (*point - *from).dot(*toward).abs() / toward.length(),
            Area::Polygon(corners) => distance_squared(sides(corners), point).map_or(f64::INFINITY, f64::sqrt),
        };
        self.regions.iter().map(distance).fold(f64::INFINITY, f64::min)
    }

    /// Returns the steepest of its grades.
    pub(super) fn steepest(&self) -> f64 {
        self.regions.iter().map(|region| region.grade.length()).fold(self.grade.length(), f64::max)
    }

    /// Returns `true` if it has no grade anywhere.
    pub(super) fn is_level(&self) -> bool {
        self.steepest() == 0.0
    }
}

impl<T> Ground<T> {
    /// Converts the ground to another scalar type.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> Ground<U> {
        let region =
            |region: Region<T>| Region { friction: f(region.friction), grade: region.grade.map(&mut f), area: region.area.map(&mut f) };
        let regions = self.regions.into_iter().map(region).collect();
        Ground {
            friction: f(self.friction),
            grade: self.grade.map(&mut f),
            regions,
            contact_length: f(self.contact_length),
            gravity: f(self.gravity),
        }
    }
}

impl<T> Area<T> {
    fn map<U>(self, mut f: impl FnMut(T) -> U) -> Area<U> {
        match self {
            Area::HalfPlane { from, toward } => Area::HalfPlane { from: from.map(&mut f), toward: toward.map(&mut f) },
            Area::Polygon(corners) => Area::Polygon(corners.into_iter().map(|corner| corner.map(&mut f)).collect()),
        }
    }
}

impl<T: Real<Mask = bool>> Ground<T> {
    /// Multiplies every friction by a factor.
    #[must_use]
    pub fn times(self, factor: T) -> Self {
        let region = |region: Region<T>| Region { friction: region.friction * factor.clone(), ..region };
        Ground { friction: self.friction * factor.clone(), regions: self.regions.into_iter().map(region).collect(), ..self }
    }

    /// Returns the friction under a wheel.
    ///
    /// Over the contact length it changes from one to the other by w³(10 − 15w + 6w²), equally inside and outside, so that a wheel that rolls straight across
    /// loses the same energy as at a border without width.
    pub fn friction_at(&self, point: &Xy<T>) -> T {
        self.surface_at(point).friction
    }

    /// Returns friction and grade under a wheel, both of which change over the contact length as the friction does.
    pub fn surface_at(&self, point: &Xy<T>) -> Surface<T> {
        let mut surface = Surface { friction: self.friction.clone(), grade: self.grade.clone() };
        for region in &self.regions {
            let inside = region.area.share(point, &self.contact_length);
            let Surface { friction, grade } = surface;
            surface = Surface {
                friction: friction.clone() + inside.clone() * (region.friction.clone() - friction),
                grade: grade.clone() + (region.grade.clone() - grade) * inside,
            };
        }
        surface
    }
}

impl<T: Real<Mask = bool>> Area<T> {
    /// Returns the share of a contact of some length that lies inside, from 0 to 1.
    fn share(&self, point: &Xy<T>, length: &T) -> T {
        let (zero, one) = (T::int(0), T::int(1));
        let reach = length.clone().half();
        let depth = match self {
            Area::HalfPlane { from, toward } => (point.clone() - from.clone()).dot(toward.clone()) / toward.clone().length(),
            // Two corners are a line, one is a point: neither has an inside.
            Area::Polygon(corners) if corners.len() < 3 => return zero,
            Area::Polygon(corners) => {
                let is_inside = contains(corners, point);
                // The root is computed only where needed, and never of zero with derivatives.
                let near = sides(corners).filter(|side| is_near(side, point, &reach));
                let Some(to_border) = distance_squared(near, point).filter(|it| it.less(&reach.clone().squared())) else {
                    return if is_inside { one } else { zero };
                };
                let distance = to_border.square_root();
                if is_inside { distance } else { -distance }
            }
        };
        if !depth.less(&reach) {
            return one;
        }
        if !(-reach.clone()).less(&depth) {
            return zero;
        }
        let share = (depth + reach) / length.clone();
        let rest = T::int(10) - T::int(15) * share.clone() + T::int(6) * share.clone().squared();
        share.clone().squared() * share * rest
    }
}

/// Returns the sides of a polygon, from corner to corner.
fn sides<T>(corners: &[Xy<T>]) -> impl Iterator<Item = (&Xy<T>, &Xy<T>)> {
    corners.iter().zip(corners.iter().cycle().skip(1))
}

/// Returns `true` if a ray from the point, along x, crosses the border an odd number of times.
fn contains<T: Real<Mask = bool>>(corners: &[Xy<T>], point: &Xy<T>) -> bool {
    sides(corners).fold(false, |inside, (a, b)| {
        let (starts_above, ends_above) = (point.y.less(&a.y), point.y.less(&b.y));
        if starts_above == ends_above {
            return inside;
        }
        let side = (b.clone() - a.clone()).cross(point.clone() - a.clone());
        // To the left of a side that goes up, or to the right of one that goes down: the ray crosses it.
        let crosses = if ends_above { T::int(0).less(&side) } else { side.less(&T::int(0)) };
        inside != crosses
    })
}

/// Returns `false` if the point is farther than the reach from a side, as the side's extent along x and y tells at once.
fn is_near<T: Real<Mask = bool>>((a, b): &(&Xy<T>, &Xy<T>), point: &Xy<T>, reach: &T) -> bool {
    let within = |a: &T, b: &T, at: &T| {
        let (least, most) = (at.clone() - reach.clone(), at.clone() + reach.clone());
        !(a.less(&least) && b.less(&least) || most.less(a) && most.less(b))
    };
    within(&a.x, &b.x, &point.x) && within(&a.y, &b.y, &point.y)
}

/// Returns the square of the distance from the nearest of some sides.
fn distance_squared<'a, T: Real<Mask = bool> + 'a>(sides: impl Iterator<Item = (&'a Xy<T>, &'a Xy<T>)>, point: &Xy<T>) -> Option<T> {
    let of_side = |(a, b): (&Xy<T>, &Xy<T>)| {
        let (zero, one) = (T::int(0), T::int(1));
        let (side, from) = (b.clone() - a.clone(), point.clone() - a.clone());
        let length_squared = side.clone().length_squared();
        if !zero.less(&length_squared) {
            return from.length_squared();
        }
        let along = from.clone().dot(side.clone()) / length_squared;
        let along = if along.less(&zero) { zero } else { along };
        let along = if one.less(&along) { one } else { along };
        (from - side * along).length_squared()
    };
    let nearer = |a: T, b: T| if b.less(&a) { b } else { a };
    sides.map(of_side).reduce(nearer)
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    const fn at(x: f64, y: f64) -> Xy {
        Xy { x, y }
    }

    /// A square from 0 to 10 m without its upper right quarter.
    fn corner() -> Area {
        Area::Polygon(vec![at(0.0, 0.0), at(10.0, 0.0), at(10.0, 5.0), at(5.0, 5.0), at(5.0, 10.0), at(0.0, 10.0)])
    }

    #[test]
    fn a_polygon_knows_its_inside_whichever_way_round() {
        let Area::Polygon(mut corners) = corner() else { panic!("a polygon") };
        for _ in 0..2 {
            let area = Area::Polygon(corners.clone());
            let share = |x, y| area.share(&at(x, y), &0.2);
            assert_eq!([share(2.0, 2.0), share(7.0, 7.0), share(7.0, 2.0), share(2.0, 7.0), share(-1.0, 5.0)], [1.0, 0.0, 1.0, 1.0, 0.0]);
            // Half of a contact on the border.
            assert!((share(10.0, 2.0) - 0.5).abs() < 1e-12 && (share(2.0, 0.0) - 0.5).abs() < 1e-12);
            corners.reverse();
        }
    }

    #[test]
    fn without_three_corners_nothing_is_inside() {
        for corners in [vec![], vec![at(1.0, 1.0)], vec![at(0.0, 0.0), at(2.0, 2.0)]] {
            assert_eq!(Area::Polygon(corners).share(&at(1.0, 1.0), &0.2), 0.0);
        }
        assert_eq!(Area::Polygon(vec![at(0.0, 0.0), at(4.0, 0.0), at(0.0, 4.0)]).share(&at(1.0, 1.0), &0.2), 1.0);
    }

    #[test]
    fn the_border_of_a_half_plane_is_passed_smoothly_and_evenly() {
        let ground = Ground { regions: vec![half_plane(0.3)], ..Ground::uniform(0.7) };
        assert_eq!(ground.friction_at(&at(9.8, 1.0)), 0.7);
        assert!((ground.friction_at(&at(10.3, -4.0)) - 0.3).abs() < 1e-15);
        let (before, behind) = (ground.friction_at(&at(9.96, 0.0)), ground.friction_at(&at(10.04, 0.0)));
        assert!((before + behind - 1.0).abs() < 1e-12 && behind < 0.5);
    }

    fn half_plane(friction: f64) -> Region {
        Region { friction, grade: Xy::zero(), area: Area::HalfPlane { from: at(10.0, 0.0), toward: at(3.0, 0.0) } }
    }

    #[test]
    fn the_last_region_holds() {
        let square = Region { friction: 0.5, grade: at(0.1, 0.0), area: corner() };
        let area = Area::HalfPlane { from: at(-99.0, 0.0), toward: at(1.0, 0.0) };
        let everywhere = Region { friction: 0.1, grade: at(0.0, 0.2), area };
        let ground = |regions| Ground { regions, ..Ground::uniform(0.7) };
        let both = ground(vec![everywhere.clone(), square.clone()]).surface_at(&at(2.0, 2.0));
        assert!((both.friction - 0.5).abs() < 1e-15 && (both.grade - at(0.1, 0.0)).length() < 1e-15);
        let both = ground(vec![square, everywhere]).surface_at(&at(2.0, 2.0));
        assert!((both.friction - 0.1).abs() < 1e-15 && (both.grade - at(0.0, 0.2)).length() < 1e-15);
    }

    #[test]
    fn a_factor_multiplies_every_friction() {
        let ground = Ground { regions: vec![half_plane(0.25)], ..Ground::uniform(0.75) }.times(2.0);
        assert_eq!([ground.friction_at(&at(0.0, 0.0)), ground.friction_at(&at(20.0, 0.0))], [1.5, 0.5]);
    }

    #[test]
    fn the_share_falls_with_the_distance_from_sides_and_corners() {
        let Area::Polygon(mut corners) = corner() else { panic!("a polygon") };
        // A repeated corner is a side without length.
        corners.insert(1, corners[1]);
        let area = Area::Polygon(corners);
        // By hand: w³(10 − 15w + 6w²) at 0.25 and 0.75, a quarter of the contact length beside the border: 53/512 and 459/512.
        let share = |x, y| area.share(&at(x, y), &0.2) * 512.0;
        for (x, y, expected) in
            [(10.05, 2.0, 53.0), (9.95, 2.0, 459.0), (10.03, -0.04, 53.0), (2.0, 9.95, 459.0), (-9.0, 0.0, 0.0), (19.0, 5.0, 0.0)]
        {
            assert!((share(x, y) - expected).abs() < 1e-9, "{} at {x} {y}", share(x, y));
        }
    }

    #[test]
    fn an_area_has_an_inside_unless_it_is_a_line() {
        let has_inside = |corners: &[Xy]| Area::Polygon(corners.to_vec()).has_inside();
        assert!(has_inside(&[at(0.0, 0.0), at(1.0, 0.0), at(2.0, 0.0), at(2.0, 1.0)]) && corner().has_inside());
        assert!(!has_inside(&[at(1.0, 0.0), at(1.0, 1.0)]) && !has_inside(&[at(0.0, 1.0), at(1.0, 2.0), at(2.0, 3.0)]));
        let along = |toward| Area::HalfPlane { from: at(1.0, 1.0), toward }.has_inside();
        assert!(along(at(0.0, -1.0)) && !along(at(0.0, 0.0)));
    }
}
