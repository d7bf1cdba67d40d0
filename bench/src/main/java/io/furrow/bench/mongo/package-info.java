/** How fast missions get into MongoDB, against a bare loop around its driver. */
package io.furrow.bench.mongo;
