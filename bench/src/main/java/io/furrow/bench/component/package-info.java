/** Runs short variants of the benches of all components and tabulates the changes in speed. */
package io.furrow.bench.component;
