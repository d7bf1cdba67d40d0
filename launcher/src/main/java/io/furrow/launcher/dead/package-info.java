/** Dead letters, brought back to where they came from. */
package io.furrow.launcher.dead;
