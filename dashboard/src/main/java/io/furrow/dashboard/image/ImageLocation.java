package io.furrow.dashboard.image;

import java.net.URI;

/**
 * Where an image is, as {@code data.images} says.
 *
 * @param contentType an image type
 */
record ImageLocation(String sha256, URI location, String contentType) {}
