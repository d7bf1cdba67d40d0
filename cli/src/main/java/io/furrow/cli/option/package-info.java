/** Options that several commands have. */
package io.furrow.cli.option;
