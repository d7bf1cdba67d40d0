/** Measures how fast images are stored. */
package io.furrow.bench.image;
