/** Where figures of several measurements are stored until all of them are there. */
package io.furrow.bench.results;
