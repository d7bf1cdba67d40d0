/** How what analytics found in one skip events differs from what it found in another: reads, matches, shows. */
package io.furrow.cli.compare;
