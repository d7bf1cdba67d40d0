/** Common parts of the commands: options, and the failure that the terminal shows as one sentence. */
package io.furrow.cli.option;
