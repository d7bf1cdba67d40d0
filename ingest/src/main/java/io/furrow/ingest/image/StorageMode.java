package io.furrow.ingest.image;

/**
 * Decides which instance writes the files of images. If several instances share the work, each must determine an image's name
 * without access to the store: then every name ends in the hash of its image.
 */
public enum StorageMode {
    /** This instance, the only one. A name has a hash only if another image has taken it. */
    ALL,
    /** This instance, also for those that only refer to images. */
    FOR_OTHERS,
    /** Another instance: this one puts references into events, possibly before the files exist. */
    BY_OTHERS
}
