/** Options that several commands share. */
package io.furrow.launcher.option;
