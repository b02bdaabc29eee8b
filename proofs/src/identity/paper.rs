//! The paper's equations, as corrected, compared with the matrix form.

use planar_impact::energy::work;
use planar_impact::paper::{self, PaperNotation};
use planar_impact::{Body, Collision, Contact, CrushPlane, Field, ForwardLeft, Heading, Impact, Motion, Nt, Party, Response, Vehicle, Xy};

use super::scene::Scene;
use super::{Identity, identity};
use crate::equation::Equations;
use crate::free::Free;

pub(super) fn all() -> Vec<Identity> {
    vec![
        identity!(eq1, "Eq 1", "½ m̄ q v_m² (1 + e) [2 + 2μr − (1 + e) q (1 + μ² + m̄ d_e²/I₁ + m̄ d_f²/I₂)] = T_L", "Eq 1"),
        identity!(eq2, "Eq 2, squared", "(m_i ΔV_i)² = 2 m̄ (1 + e) q (1 + μ²) T_L/[bracket of Eq 1], i = 1, 2", "Eq 2"),
        identity!(eq5, "Eq 5", "½ P (V + v) is the opposite of the work against the relative velocity of 2 less 1", "Eq 5"),
        identity!(eq6, "Eq 6", "W_p by the velocities of both bodies at C = W_n + W_t = −T_L", "Eq 6"),
        identity!(eq7, "Eq 7, as a work", "½ P_n [(v_1Cn − v_2Cn) + (V_1Cn − V_2Cn)] = W_n = −E_C", "Eq 7"),
        identity!(eq8, "Eq 8, as a work", "½ P_t [(v_1Ct − v_2Ct) + (V_1Ct − V_2Ct)] = W_t = −E_T", "Eq 8"),
        identity!(a1, "A1", "V_1n − v_1n = m̄ (1 + e) v_m q/m₁", "A1"),
        identity!(a2, "A2", "V_1t − v_1t = μ m̄ (1 + e) v_m q/m₁", "A2"),
        identity!(a3, "A3", "V_2n − v_2n = −m̄ (1 + e) v_m q/m₂", "A3"),
        identity!(a4, "A4", "V_2t − v_2t = −μ m̄ (1 + e) v_m q/m₂", "A4"),
        identity!(a5, "A5", "Ω₁ − ω₁ = m̄ (1 + e) v_m (d_c − μ d_d) q/(m₁ k₁²)", "A5"),
        identity!(a6, "A6", "Ω₂ − ω₂ = m̄ (1 + e) v_m (d_a − μ d_b) q/(m₂ k₂²)", "A6"),
        identity!(a7, "A7", "e = −V_Cm/v_Cm", "A7"),
        identity!(a8, "A8", "μ = P_t/P_n", "A8"),
        identity!(a9_a10, "A9, A10", "I = m k²: all of the mass at the radius of gyration has the same energy", "A9, A10"),
        identity!(a11, "A11, corrected", "v_m = (v_2n − d_a ω₂) − (v_1n + d_c ω₁) = v_n", "A11"),
        identity!(a12, "A12", "V_Cm = V_1n + d_c Ω₁ − V_2n + d_a Ω₂ = −V_n", "A12"),
        identity!(a13, "A13", "v_Cm = v_1n + d_c ω₁ − v_2n + d_a ω₂ = −v_n", "A13"),
        identity!(a14, "A14", "1/q = m̄ (K_nn + μ K_nt)", "A14"),
        identity!(a15, "A15", "d_a = d₂ sin(θ₂ + φ₂ − Γ) = r_2t, φ₂ from the center of mass to C", "A15"),
        identity!(a16, "A16, corrected", "d_b = d₂ cos(θ₂ + φ₂ − Γ) = r_2n", "A16"),
        identity!(a17, "A17, corrected", "d_c = d₁ sin(θ₁ + φ₁ − Γ) = −r_1t, φ₁ from C to the center of mass", "A17"),
        identity!(a18, "A18", "d_d = d₁ cos(θ₁ + φ₁ − Γ) = −r_1n", "A18"),
        identity!(a19, "A19", "d_e = d_c − μ d_d = (r₁ × (1, μ))", "A19"),
        identity!(a20, "A20", "d_f = d_a − μ d_b = −(r₂ × (1, μ))", "A20"),
        identity!(a21, "A21, corrected", "r = [(v_2t + d_b ω₂) − (v_1t − d_d ω₁)]/v_m = v_t/v_n", "A21"),
        identity!(a22_a23, "A22, A23", "P_x = m₁ (V_1x − v_1x), P_y = m₁ (V_1y − v_1y)", "A22, A23"),
        identity!(a24_a25, "A24, A25", "P_n = P_x cos Γ + P_y sin Γ, P_t = −P_x sin Γ + P_y cos Γ", "A24, A25"),
        identity!(a26, "A26", "m̄ = m₁ m₂/(m₁ + m₂), m̄ (1/m₁ + 1/m₂) = 1", "A26"),
        identity!(a27, "A27", "μ0 = [r A + (1 + e) B]/[(1 + e)(1 + C) + r B] = P_t/P_n where V_t = 0", "A27"),
        identity!(a28, "A28", "A = 1 + m̄ (d_c²/I₁ + d_a²/I₂) = m̄ K_nn", "A28"),
        identity!(a29, "A29", "B = m̄ (d_c d_d/I₁ + d_a d_b/I₂) = −m̄ K_nt", "A29"),
        identity!(a30, "A30", "1 + C = 1 + m̄ (d_d²/I₁ + d_b²/I₂) = m̄ K_tt", "A30"),
    ]
}

/// A collision of two vehicles at any ratio, and the paper's symbols for it.
struct Lettered<T> {
    scene: Scene<T>,
    letters: PaperNotation<T>,
}

fn lettered<T: Field>(free: &mut Free<'_, T>) -> Lettered<T> {
    let (collision, ratio) = (free.collision(), free.variable());
    let scene = Scene::at_ratio(collision, ratio.clone());
    let letters = PaperNotation::of(&scene.contact.one, &scene.contact.two, scene.collision.restitution.clone(), ratio);
    Lettered { scene, letters }
}

impl<T: Field> Lettered<T> {
    /// Returns V − v of a vehicle, in n-t axes.
    fn gained(&self, response: fn(&Impact<T>) -> &Response<T>) -> Nt<T> {
        self.scene.collision.crush_plane.to_contact(response(&self.scene.impact).delta_v.clone())
    }
}

/// Returns one equation: a quantity of a collision on the left, the paper's symbols on the right.
fn one<T: Field>(free: &mut Free<'_, T>, sides: fn(&Lettered<T>) -> (T, T)) -> Equations<T> {
    let (left, right) = sides(&lettered(free));
    let mut must = Equations::new();
    must.equal(left, right);
    must
}

fn eq1<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.loss(), it.letters.eq1()))
}

fn eq2<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Lettered { scene, letters } = lettered(free);
    let mut must = Equations::new();
    let squared = letters.eq2_squared(scene.impact.loss());
    for side in scene.sides() {
        must.equal((side.response.delta_v.clone() * side.vehicle.mass.clone()).length_squared(), squared.clone());
    }
    must
}

fn eq5<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (p, before, after) = (free.variable(), free.variable(), free.variable());
    let mut must = Equations::new();
    let by_paper = paper::eq5(p.clone(), after.clone(), before.clone());
    must.equal(T::int(2) * by_paper.clone(), p.clone() * after.clone() + p.clone() * before.clone());
    must.equal(by_paper, -work(p, before, after));
    must
}

fn eq6<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Lettered { scene, .. } = lettered(free);
    let before = [&scene.contact.one, &scene.contact.two].map(Body::velocity_at_center);
    let after = scene.bodies_after().map(|body| body.velocity_at_center());
    let work = paper::eq6(scene.impact.impulse.clone(), before, after);
    let mut must = Equations::new();
    must.equal(work.clone(), -scene.impact.loss());
    must.equal(work, scene.impact.work.n + scene.impact.work.t);
    must
}

fn eq7<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.work.n.clone(), it.letters.eq7()))
}

fn eq8<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.work.t.clone(), it.letters.eq8()))
}

fn a1<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.gained(|impact| &impact.one).n, it.letters.a1()))
}

fn a2<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.gained(|impact| &impact.one).t, it.letters.a2()))
}

fn a3<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.gained(|impact| &impact.two).n, it.letters.a3()))
}

fn a4<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.gained(|impact| &impact.two).t, it.letters.a4()))
}

fn a5<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.one.after.yaw_rate.clone() - it.letters.omega_1.clone(), it.letters.a5()))
}

fn a6<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.two.after.yaw_rate.clone() - it.letters.omega_2.clone(), it.letters.a6()))
}

fn a7<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Lettered { scene, letters } = lettered(free);
    let mut must = Equations::new();
    must.equal(paper::a7(letters.a12(), letters.a13()), letters.e);
    must.equal(paper::a7(scene.impact.separation.n, scene.impact.approach.n), scene.collision.restitution);
    must
}

fn a8<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (paper::a8(it.scene.impact.impulse.clone()), it.letters.mu.clone()))
}

fn a9_a10<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let (mass, radius, spin) = (free.variable(), free.variable(), free.variable());
    let spinning = Vehicle {
        mass: mass.clone(),
        yaw_inertia: paper::a9_a10(mass.clone(), radius.clone()),
        heading: free.heading(),
        impact_center: ForwardLeft::zero(),
        motion: Motion::rest(),
    };
    let mut must = Equations::new();
    let energy = spinning.kinetic_energy(Motion { velocity: Xy::zero(), yaw_rate: spin.clone() });
    must.equal(T::int(2) * energy, mass * (radius * spin).squared());
    must
}

fn a11<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.approach.n.clone(), it.letters.a11()))
}

fn a12<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (-it.scene.impact.separation.n.clone(), it.letters.a12()))
}

fn a13<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (-it.scene.impact.approach.n.clone(), it.letters.a13()))
}

fn a14<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| {
        let along = it.scene.contact.compliance.along_ratio(it.letters.mu.clone());
        (it.letters.m_bar() * along * it.letters.a14(), T::int(1))
    })
}

/// Returns the direction of the sum of two angles.
fn plus<T: Field>(a: &Heading<T>, b: &Heading<T>) -> Heading<T> {
    let sum = a.to_ground(ForwardLeft { forward: b.cos.clone(), left: b.sin.clone() });
    Heading { cos: sum.x, sin: sum.y }
}

/// Position of C on a vehicle in the paper's form: a distance d, and the direction θ + φ − Γ.
struct Bearing<T> {
    distance: T,
    direction: Heading<T>,
}

/// A collision whose impact centers are given by bearings, in the paper's symbols.
struct Located<T> {
    letters: PaperNotation<T>,
    one: Bearing<T>,
    two: Bearing<T>,
}

fn located<T: Field>(free: &mut Free<'_, T>) -> Located<T> {
    let collision = free.collision();
    let CrushPlane { cos, sin } = collision.crush_plane.clone();
    let back = Heading { cos, sin: -sin };
    let mut place = |party: &Party<T>, toward_center: i32| {
        let (vehicle, distance, phi) = (party.vehicle().expect("a vehicle").clone(), free.variable(), free.heading());
        let direction = plus(&plus(&vehicle.heading, &phi), &back);
        let along = T::int(toward_center) * distance.clone();
        let impact_center = ForwardLeft { forward: along.clone() * phi.cos, left: along * phi.sin };
        (Party::from(Vehicle { impact_center, ..vehicle }), Bearing { distance, direction })
    };
    // φ₁ points from C to the center of mass, φ₂ from the center of mass to C.
    let (one, bearing_of_one) = place(&collision.one, -1);
    let (two, bearing_of_two) = place(&collision.two, 1);
    let Contact { one, two, .. } = Collision { one, two, ..collision }.contact();
    Located { letters: PaperNotation::of(&one, &two, T::int(0), T::int(0)), one: bearing_of_one, two: bearing_of_two }
}

fn arm<T: Field>(free: &mut Free<'_, T>, sides: fn(Located<T>) -> (T, T)) -> Equations<T> {
    let (left, right) = sides(located(free));
    let mut must = Equations::new();
    must.equal(left, right);
    must
}

fn a15<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    arm(free, |it| (it.letters.d_a, it.two.distance * it.two.direction.sin))
}

fn a16<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    arm(free, |it| (it.letters.d_b, it.two.distance * it.two.direction.cos))
}

fn a17<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    arm(free, |it| (it.letters.d_c, it.one.distance * it.one.direction.sin))
}

fn a18<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    arm(free, |it| (it.letters.d_d, it.one.distance * it.one.direction.cos))
}

/// Returns r × (1, μ), the moment of an impulse at the ratio μ.
fn moment_of_ratio<T: Field>(body: &Body<T>, ratio: T) -> T {
    body.arm.n.clone() * ratio - body.arm.t.clone()
}

fn a19<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (moment_of_ratio(&it.scene.contact.one, it.letters.mu.clone()), it.letters.a19()))
}

fn a20<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (-moment_of_ratio(&it.scene.contact.two, it.letters.mu.clone()), it.letters.a20()))
}

fn a21<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.scene.impact.approach.t.clone() / it.scene.impact.approach.n.clone(), it.letters.a21()))
}

fn a22_a23<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Lettered { scene, letters } = lettered(free);
    let before = scene.collision.one.vehicle().expect("a vehicle").motion.velocity.clone();
    let mut must = Equations::new();
    must.equal(paper::a22_a23(letters.m_1, before, scene.impact.one.after.velocity), scene.impact.impulse_on_ground);
    must
}

fn a24_a25<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let scene = lettered(free).scene;
    let mut must = Equations::new();
    must.equal(paper::a24_a25(scene.impact.impulse_on_ground, &scene.collision.crush_plane), scene.impact.impulse);
    must
}

fn a26<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let letters = lettered(free).letters;
    let (m_1, m_2) = (letters.m_1.clone(), letters.m_2.clone());
    let mut must = Equations::new();
    must.equal(paper::a26(m_1.clone(), m_2.clone()) * (m_1.clone().inv() + m_2.clone().inv()), T::int(1));
    must.equal(letters.m_bar(), paper::a26(m_1, m_2));
    must
}

fn a27<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    let Lettered { scene, letters } = lettered(free);
    let at_critical = Scene::at_ratio(scene.collision.clone(), letters.a27());
    let mut must = Equations::new();
    must.equal(letters.a27(), scene.impact.critical_impulse_ratio());
    must.equal(at_critical.impact.separation.t, T::int(0));
    must
}

fn a28<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.letters.m_bar() * it.scene.contact.compliance.nn().clone(), it.letters.a28()))
}

fn a29<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (-(it.letters.m_bar() * it.scene.contact.compliance.nt().clone()), it.letters.a29()))
}

fn a30<T: Field>(free: &mut Free<'_, T>) -> Equations<T> {
    one(free, |it| (it.letters.m_bar() * it.scene.contact.compliance.tt().clone(), T::int(1) + it.letters.a30()))
}
