package io.furrow.ingest.image;

import java.io.IOException;

import io.furrow.mission.image.ImageName;

/** A store of images. */
interface ImageStore {
    /**
     * Returns the location of an image, after writing it if that is this instance's part.
     *
     * @throws IOException if the store does not accept it; the call may be retried
     */
    StoredImage store(ImageName name, Image image) throws IOException;

    /** @throws IOException if there is no file system for the root's kind of URI and one is needed */
    static ImageStore of(ImageSettings settings) throws IOException {
        String root = settings.root();
        return switch (settings.storageMode()) {
            case ALL -> ImageFiles.in(root);
            case FOR_OTHERS -> ImageFiles.in(root)::storeByHash;
            case BY_OTHERS ->
                (name, image) ->
                        StoredImage.of(root + "/" + name.path(image.format().extension(), image.sha256()), image);
        };
    }
}
