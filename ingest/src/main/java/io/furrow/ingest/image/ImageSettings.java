package io.furrow.ingest.image;

import java.io.Serializable;
import java.time.Duration;
import java.util.Set;

/**
 * The settings for moving images.
 *
 * @param root of the store, an absolute URI without a trailing slash
 * @param attributes names of the attributes that contain images
 * @param maxBytes of one image
 * @param threads that read and write images, per subtask
 * @param maxInFlightBytes of events that wait for an image to be written, per subtask
 * @param timeout for retries with an unavailable store before the job fails
 */
record ImageSettings(
        String root,
        Set<String> attributes,
        int maxBytes,
        int threads,
        long maxInFlightBytes,
        Duration timeout,
        StorageMode storageMode)
        implements Serializable {}
