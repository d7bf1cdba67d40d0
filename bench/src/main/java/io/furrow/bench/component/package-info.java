/** The benches of all components in short forms, one table, and what became faster or slower. */
package io.furrow.bench.component;
