//! Every variant of every kind of trouble is produced by the library, and told in the right words.
//!
//! The matches are exhaustive: a variant that is added does not compile without a case here.

/// Checks each variant: a value that the library makes, and what it says.
macro_rules! each_variant {
    ($kind:ty: $($variant:pat => $made:expr, $words:expr;)+) => {{
        #[allow(unused_variables)]
        let _ = |value: $kind| match value { $($variant => ()),+ };
        $(
            let made: $kind = $made;
            let $variant = &made else { panic!("{made:?}") };
            assert_eq!(made.to_string(), $words);
        )+
    }};
}

mod cause;
mod error;
mod mistake;
mod status;
mod storage;
