//! Listing of a formula: the quantity itself and all quantities in it, each with its definition.

use super::expression::{Choice, Expression, Form, Name};
use alloc::format;
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::cmp::Reverse;

/// A formula with its definitions, each quantity before those that it contains.
pub(super) struct Listing {
    pub(super) entries: Vec<Entry>,
    /// Variables in order of appearance.
    pub(super) variables: Vec<Arc<str>>,
}

/// A quantity and its definition.
pub(super) struct Entry {
    pub(super) label: Label,
    /// The quantity as it appears in other definitions; `None` for the formula itself.
    reference: Option<Expression>,
    pub(super) value: Expression,
}

/// A unique name of a quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Label {
    pub(super) name: Name,
    /// Number of quantities with the same name before this one.
    pub(super) primes: usize,
}

impl Listing {
    /// Creates the listing of a quantity. Its definitions that are in `known` come in that order, as far as their depth allows.
    pub(super) fn of(name: &Name, value: &Expression, known: &[&str]) -> Listing {
        let mut entries = Vec::from([Entry { label: Label { name: name.clone(), primes: 0 }, reference: None, value: value.clone() }]);
        let mut variables = Vec::new();
        let mut at = 0;
        while at < entries.len() {
            let value = entries[at].value.clone();
            visit(&value, &mut entries, &mut variables);
            at += 1;
        }
        let mut listing = Listing { entries, variables };
        listing.name_what_is_repeated();
        listing.sort(known);
        listing.tell_apart();
        listing
    }

    /// Returns the name of a quantity in this listing.
    pub(super) fn label(&self, quantity: &Expression) -> &Label {
        let is_it = |entry: &&Entry| entry.reference.as_ref().is_some_and(|reference| reference.equals(quantity));
        &self.entries.iter().find(is_it).expect("every quantity is listed").label
    }

    /// Numbers long expressions that occur more than once, and every choice inside an expression except magnitudes.
    fn name_what_is_repeated(&mut self) {
        let mut number = 0;
        while let Some(repeated) = self.repeated() {
            number += 1;
            let reference = repeated.clone().named(Name::of(&format!("s{number}")));
            for entry in &mut self.entries {
                entry.value = entry.value.replaced(&mut |part| {
                    let equivalence = (!matches!(part.form(), Form::Named(..))).then(|| part.equivalence(&repeated))??;
                    Some(reference.times(&num_rational::BigRational::from_integer(equivalence.sign().into())))
                });
            }
            self.entries.push(Entry {
                label: Label { name: Name::of(&format!("s{number}")), primes: 0 },
                reference: Some(reference),
                value: repeated,
            });
        }
    }

    /// Returns the longest expression to be numbered.
    fn repeated(&self) -> Option<Expression> {
        let mut met: Vec<(Expression, usize)> = Vec::new();
        for entry in &self.entries {
            // The definition itself already has a name, and so does the last alternative of its choice.
            inside(&entry.value, true, &mut |part| match met.iter_mut().find(|(other, _)| other.equivalence(part).is_some()) {
                Some((_, times)) => *times += 1,
                None => met.push((part.clone(), 1)),
            });
        }
        let deserves = |(part, times): &(Expression, usize)| match part.form() {
            Form::Choice(choice) if choice.magnitude().is_none() => true,
            _ => *times > 1 && length(part) >= LONG,
        };
        met.into_iter().filter(deserves).max_by_key(|(part, _)| length(part)).map(|(part, _)| part)
    }

    /// Sorts the formula first, then the quantities with the most computation steps.
    fn sort(&mut self, known: &[&str]) {
        let mut depths: Vec<Option<usize>> = self.entries.iter().map(|_| None).collect();
        for at in 0..self.entries.len() {
            self.depth(at, &mut depths);
        }
        let mut order: Vec<usize> = (1..self.entries.len()).collect();
        let place = |at: usize| known.iter().position(|known| **known == *self.entries[at].label.name.symbol).unwrap_or(known.len());
        order.sort_by_key(|&at| (Reverse(depths[at]), place(at)));
        let mut entries: Vec<Option<Entry>> = self.entries.drain(..).map(Some).collect();
        self.entries = core::iter::once(0).chain(order).filter_map(|at| entries[at].take()).collect();
    }

    fn depth(&self, at: usize, depths: &mut Vec<Option<usize>>) -> usize {
        if let Some(depth) = depths[at] {
            return depth;
        }
        let mut quantities = Vec::new();
        quantities_in(&self.entries[at].value, &mut quantities);
        let places = quantities.iter().filter_map(|quantity| {
            self.entries.iter().position(|entry| entry.reference.as_ref().is_some_and(|reference| reference.equals(quantity)))
        });
        let depth = places.map(|place| self.depth(place, depths) + 1).max().unwrap_or(0);
        depths[at] = Some(depth);
        depth
    }

    /// Adds primes to names that another quantity or a variable already has.
    fn tell_apart(&mut self) {
        for at in 0..self.entries.len() {
            let label = self.entries[at].label.clone();
            let earlier = self.entries[..at].iter().filter(|entry| entry.label.name == label.name).count();
            let is_itself = matches!(self.entries[at].value.form(), Form::Variable(name) if *name == label.name.symbol);
            let variable = !is_itself && self.variables.contains(&label.name.symbol);
            self.entries[at].label.primes = earlier + usize::from(variable);
        }
    }
}

/// Number of symbols from which an expression is long.
const LONG: usize = 10;

/// Returns the number of symbols in an expression.
pub(super) fn length(expression: &Expression) -> usize {
    match expression.form() {
        Form::Number(_) | Form::Variable(_) | Form::Named(..) => 1,
        _ => expression.parts().into_iter().map(length).sum(),
    }
}

/// Lists the quantities and variables that occur in an expression for the first time.
fn visit(expression: &Expression, entries: &mut Vec<Entry>, variables: &mut Vec<Arc<str>>) {
    match expression.form() {
        Form::Variable(name) if !variables.contains(name) => variables.push(name.clone()),
        Form::Named(name, value) => {
            if !entries.iter().any(|entry| entry.reference.as_ref().is_some_and(|reference| reference.equals(expression))) {
                entries.push(Entry {
                    label: Label { name: name.clone(), primes: 0 },
                    reference: Some(expression.clone()),
                    value: value.clone(),
                });
            }
        }
        _ => expression.parts().into_iter().for_each(|part| visit(part, entries, variables)),
    }
}

fn quantities_in(expression: &Expression, quantities: &mut Vec<Expression>) {
    match expression.form() {
        Form::Named(..) => quantities.push(expression.clone()),
        _ => expression.parts().into_iter().for_each(|part| quantities_in(part, quantities)),
    }
}

/// Calls for each part that is not a symbol and has no name of its own.
fn inside(expression: &Expression, named: bool, call: &mut impl FnMut(&Expression)) {
    match expression.form() {
        Form::Number(_) | Form::Variable(_) | Form::Named(..) => return,
        Form::Choice(Choice { left, right, yes, no }) if named => {
            for (part, named) in [(left, false), (right, false), (yes, false), (no, true)] {
                inside(part, named, call);
            }
            return;
        }
        _ if named => (),
        _ => call(expression),
    }
    expression.parts().into_iter().for_each(|part| inside(part, false, call));
}
