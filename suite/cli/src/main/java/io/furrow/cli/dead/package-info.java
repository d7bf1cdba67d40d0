/** Dead letters, brought back to where they came from. */
package io.furrow.cli.dead;
