//! Catalogues of named quantities.
//!
//! A catalogue is an enum with one row for each quantity: its documentation, its dotted name, the paper's symbol, and its measure. It is a macro because rows
//! are variants and their positions are constants: derivatives use them as indices in inner loops, where searching a table would cost more than the
//! mechanics. Accessors are matches beside their types, so that the compiler reports a missing row.

#[cfg(feature = "alloc")]
use alloc::boxed::Box;
#[cfg(feature = "alloc")]
use core::fmt;

/// A name that no quantity of a catalogue has.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// The name.
    pub name: Box<str>,
}

#[cfg(feature = "alloc")]
impl UnknownName {
    pub(crate) fn of(name: &str) -> Self {
        UnknownName { name: name.into() }
    }
}

#[cfg(feature = "alloc")]
impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no quantity is named {:?}; `ALL` lists those that exist", self.name)
    }
}

#[cfg(feature = "alloc")]
impl core::error::Error for UnknownName {}

/// Declares a catalogue: the quantities of each vehicle, in whose names `_` is the placeholder of its number, then those of the pair.
///
/// Derives `COUNT`, `ALL`, `index`, `name`, `side`, `Display`, `FromStr` by `named`, the column at the end of each row, and `symbol` if rows have one.
macro_rules! catalogue {
    (
        $(#[$about:meta])*
        pub enum $Catalogue:ident after $prefix:literal with symbols, $(#[$about_column:meta])* $column:ident: $Column:ident {
            of each vehicle {
                $($(#[$of_vehicle:meta])* $Vehicle:ident = $before:literal _ $($after:literal)?, $s_before:literal _ $($s_after:literal)?, $of:ident;)*
            }
            of the pair {
                $($(#[$of_pair:meta])* $Pair:ident = $name:literal, $symbol:literal, $of_the_pair:ident;)*
            }
        }
    ) => {
        catalogue! {
            @rows $(#[$about])*
            pub enum $Catalogue after $prefix, $(#[$about_column])* $column: $Column {
                of each vehicle { $($(#[$of_vehicle])* $Vehicle = $before _ $($after)?, $of;)* }
                of the pair { $($(#[$of_pair])* $Pair = $name, $of_the_pair;)* }
            }
        }

        impl $Catalogue {
            const SYMBOLS: [&str; $Catalogue::COUNT] = [
                $(concat!($s_before, "1" $(, $s_after)?),)*
                $(concat!($s_before, "2" $(, $s_after)?),)*
                $($symbol,)*
            ];

            /// Returns its symbol, the paper's if it has one, such as `m1` or `Gamma`.
            pub const fn symbol(self) -> &'static str {
                Self::SYMBOLS[self.index()]
            }

            fn of_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|row| row.name() == name || row.symbol() == name)
            }
        }
    };

    (
        $(#[$about:meta])*
        pub enum $Catalogue:ident after $prefix:literal, $(#[$about_column:meta])* $column:ident: $Column:ident {
            $($rows:tt)*
        }
    ) => {
        catalogue! { @rows $(#[$about])* pub enum $Catalogue after $prefix, $(#[$about_column])* $column: $Column { $($rows)* } }

        impl $Catalogue {
            fn of_name(name: &str) -> Option<Self> {
                Self::ALL.into_iter().find(|row| row.name() == name)
            }
        }
    };

    (
        @rows $(#[$about:meta])*
        pub enum $Catalogue:ident after $prefix:literal, $(#[$about_column:meta])* $column:ident: $Column:ident {
            of each vehicle { $($(#[$of_vehicle:meta])* $Vehicle:ident = $before:literal _ $($after:literal)?, $of:ident;)* }
            of the pair { $($(#[$of_pair:meta])* $Pair:ident = $name:literal, $of_the_pair:ident;)* }
        }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum $Catalogue {
            $($(#[$of_vehicle])* $Vehicle(Side),)*
            $($(#[$of_pair])* $Pair,)*
        }

        const _: () = {
            /// The rows of one vehicle.
            enum OfVehicle { $($Vehicle),* }
            /// The rows of the pair.
            enum OfPair { $($Pair),* }
            const VEHICLE_ROWS: usize = [$(OfVehicle::$Vehicle as usize),*].len();

            impl $Catalogue {
                /// Number of quantities.
                pub const COUNT: usize = 2 * VEHICLE_ROWS + [$(OfPair::$Pair as usize),*].len();

                /// All quantities: those of vehicle 1, those of vehicle 2, those of the pair.
                pub const ALL: [$Catalogue; $Catalogue::COUNT] =
                    [$($Catalogue::$Vehicle(Side::One),)* $($Catalogue::$Vehicle(Side::Two),)* $($Catalogue::$Pair,)*];

                const PREFIXED: [&str; $Catalogue::COUNT] = [
                    $(concat!($prefix, $before, "1" $(, $after)?),)*
                    $(concat!($prefix, $before, "2" $(, $after)?),)*
                    $(concat!($prefix, $name),)*
                ];

                /// Returns its position in `ALL`.
                #[inline]
                pub const fn index(self) -> usize {
                    match self {
                        $($Catalogue::$Vehicle(side) => OfVehicle::$Vehicle as usize + VEHICLE_ROWS * side as usize,)*
                        $($Catalogue::$Pair => 2 * VEHICLE_ROWS + OfPair::$Pair as usize,)*
                    }
                }

                /// Returns its dotted name.
                pub const fn name(self) -> &'static str {
                    Self::PREFIXED[self.index()].split_at($prefix.len()).1
                }

                $(#[$about_column])*
                pub const fn $column(self) -> $Column {
                    match self {
                        $($Catalogue::$Vehicle(_) => $Column::$of,)*
                        $($Catalogue::$Pair => $Column::$of_the_pair,)*
                    }
                }

                /// Returns the vehicle that it belongs to, or `None` if it belongs to the pair.
                pub const fn side(self) -> Option<Side> {
                    match self {
                        $($Catalogue::$Vehicle(side))|* => Some(side),
                        $($Catalogue::$Pair)|* => None,
                    }
                }
            }
        };

        #[cfg(feature = "alloc")]
        impl core::str::FromStr for $Catalogue {
            type Err = $crate::catalogue::UnknownName;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                Self::named(name).ok_or_else(|| $crate::catalogue::UnknownName::of(name))
            }
        }

        #[cfg(feature = "serde")]
        impl serde::Serialize for $Catalogue {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str(self.name())
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $Catalogue {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                <alloc::borrow::Cow<'de, str>>::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
            }
        }

        impl core::fmt::Display for $Catalogue {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.pad(self.name())
            }
        }
    };
}

pub(crate) use catalogue;
