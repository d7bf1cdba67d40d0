package io.furrow.ingest.image;

/**
 * Who writes the files of images. Where several instances share the work, each must know an image's name without looking into
 * the store: then every name ends in the hash of its image.
 */
public enum StorageMode {
    /** This instance, for itself alone. A name has a hash only where another image has taken it. */
    ALL,
    /** This instance, also for those that only refer to them. */
    FOR_OTHERS,
    /** Another instance: this one puts references into events, which may be there before the files are. */
    BY_OTHERS
}
