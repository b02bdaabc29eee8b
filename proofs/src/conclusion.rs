//! Conclusions from the identities by the order of the rational numbers, which no field identity can express.

use crate::proof::Proof;

/// An inequality, or another conclusion, and the identities that it depends on.
#[derive(Clone, Debug)]
pub struct Conclusion {
    /// The conclusion, in a few words.
    pub name: &'static str,
    /// The conclusion, in symbols.
    pub statement: &'static str,
    /// Reason why it follows.
    pub reason: &'static str,
    /// The names of the identities from which it follows.
    pub premises: &'static [&'static str],
    /// `true` if all of them hold.
    pub holds: bool,
}

/// A conclusion before its premises are checked.
struct Claim {
    name: &'static str,
    statement: &'static str,
    reason: &'static str,
    premises: &'static [&'static str],
}

/// Masses and inertias are positive, and 1/m = 1/I = 0 for a barrier; at least one body is free, so that w = Σ 1/m > 0.
const CLAIMS: &[Claim] = &[
    Claim {
        name: "K is positive definite",
        statement: "P·K P > 0 for every P but zero; K_nn > 0, K_tt > 0, det K > 0",
        reason: "P·K P and det K are sums of squares with weights w > 0 and 1/I ≥ 0, and the square of P has the weight w",
        premises: &["P·K P is a sum of squares", "det K"],
    },
    Claim {
        name: "the peak of T_L",
        statement: "T_L(P) ≤ ½ v·K⁻¹ v for every impulse P, under any law; equal only at e = 0, μ = μ0",
        reason: "T_L is its peak less ½ δ·K δ, which is zero only for δ = P − P* = 0; e = 0 and μ = μ0 give P*",
        premises: &["the loss is its peak less a square", "P·K P is a sum of squares", "the peak is at e = 0, μ = μ0"],
    },
    Claim {
        name: "the peak of T_L with a moment",
        statement: "no impulse and moment lose more than those that end sliding, approach and relative rotation",
        reason: "the same square with three components, a sum of squares as well",
        premises: &["with a moment the peak ends all relative motion", "(P, M)·K₃ (P, M) is a sum of squares"],
    },
    Claim {
        name: "the bound on e at the critical ratio",
        statement: "T_L ≥ 0 for every approach velocity if and only if e² ≤ 1 − K_nt²/(K_nn K_tt)",
        reason: "2 K_nn det K T_L is a square plus K_nn K_tt (1 − K_nt²/(K_nn K_tt) − e²) v_n²; the square vanishes for v_t = v_n K_nt/K_nn",
        premises: &["the same with its square completed", "the bound for any approach", "P·K P is a sum of squares", "det K"],
    },
    Claim {
        name: "the bound on e for one approach velocity",
        statement: "T_L ≥ 0 if and only if e² ≤ e₀² = v·adj(K) v/(K_tt v_n²), and e₀² is not below the bound above",
        reason: "2 det K T_L = K_tt v_n² (e₀² − e²) with K_tt > 0; the bound for any approach is the least of them",
        premises: &["the bound of restitution is where it vanishes", "the bound for any approach", "the same with its square completed"],
    },
    Claim {
        name: "between two ratios that gain nothing none does",
        statement: "for one e, T_L ≥ 0 at two tangential impulses means T_L ≥ 0 between them",
        reason: "T_L is a quadratic in P_t with the leading coefficient −det K/(2 K_nn) < 0",
        premises: &["the loss at one e is a quadratic in P_t", "det K", "P·K P is a sum of squares"],
    },
    Claim {
        name: "Kudlich–Slibar never gains",
        statement: "T_L ≥ 0 for every e from 0 to 1",
        reason: "T_L = (1 − e²) ½ P*·K P*",
        premises: &["Kudlich–Slibar keeps e² of the peak", "the peak is at e = 0, μ = μ0", "P·K P is a sum of squares"],
    },
    Claim {
        name: "how μ0 answers",
        statement: "μ0 grows with r; with e it falls where r > 0 and grows where r < 0",
        reason: "dμ0/dr and −dμ0/de over r are A (1 + C) − B² = m̄² det K > 0 over a square, times 1 + e > 0 or 1",
        premises: &["μ0 by r", "μ0 by e", "A (1 + C) − B² has the sign of det K", "det K"],
    },
    Claim {
        name: "a pushing impulse takes energy by its normal part",
        statement: "W_n ≤ 0, that is E_C ≥ 0, for e from 0 to 1 where P_n v_n ≥ 0",
        reason: "W_n = −½ (1 − e) P_n v_n",
        premises: &["restitution fixes W_n"],
    },
];

/// Returns all conclusions, with their premises checked against the proofs.
pub(crate) fn from(proofs: &[&Proof]) -> Vec<Conclusion> {
    let holds = |premise: &&str| proofs.iter().any(|proof| proof.identity.name == *premise && proof.holds());
    CLAIMS
        .iter()
        .map(|&Claim { name, statement, reason, premises }| Conclusion {
            name,
            statement,
            reason,
            premises,
            holds: !premises.is_empty() && premises.iter().all(holds),
        })
        .collect()
}
