/** Measures how long a mission takes to start. */
package io.furrow.bench.mission;
