/** Times on the command line. */
package io.furrow.cli.time;
