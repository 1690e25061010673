mod families;
mod friction;
mod page;
mod rates;
mod sliding;
mod standard;
mod verification;
mod worst_cases;
