package io.furrow.ingest.image;

import java.io.Serializable;
import java.time.Duration;
import java.util.Set;

/**
 * How images are moved.
 *
 * @param root where they are kept, an absolute URI without a slash at its end
 * @param attributes names of the attributes that hold images
 * @param maxBytes of one image
 * @param threads that read and write images, per subtask
 * @param maxInFlightBytes of events that wait for an image to be written, per subtask
 * @param timeout how long a store that does not take an image is asked again before the job fails
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
