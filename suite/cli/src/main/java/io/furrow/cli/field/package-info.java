/** Prints fields for {@code ./furrow fields}. */
package io.furrow.cli.field;
