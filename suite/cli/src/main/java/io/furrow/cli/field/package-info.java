/** Fields, as {@code ./furrow fields} reports them. */
package io.furrow.cli.field;
