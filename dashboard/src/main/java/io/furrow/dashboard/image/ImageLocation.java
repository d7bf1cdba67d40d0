package io.furrow.dashboard.image;

import java.net.URI;

/**
 * The location of an image, as named by {@code data.images}.
 *
 * @param contentType an image type
 */
record ImageLocation(String sha256, URI location, String contentType) {}
