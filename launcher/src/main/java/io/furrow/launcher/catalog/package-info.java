/** The data catalogue, read and printed. */
package io.furrow.launcher.catalog;
