/** The commands themselves; those of the control plane are in {@code control}. */
package io.furrow.cli.command;
