/** Stored images of cameras. */
package io.furrow.dashboard.image;
