/** What the commands share: their options, and the failure that the terminal shows as one sentence. */
package io.furrow.cli.option;
