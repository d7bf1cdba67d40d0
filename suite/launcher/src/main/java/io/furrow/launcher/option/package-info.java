/** Options of several commands. */
package io.furrow.launcher.option;
