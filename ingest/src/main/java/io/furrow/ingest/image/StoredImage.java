package io.furrow.ingest.image;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** A reference to an image, which replaces it in an event. */
record StoredImage(String url, String sha256, int bytes, String contentType) {
    static StoredImage of(String url, Image image) {
        return new StoredImage(
                url, image.sha256(), image.bytes().length, image.format().contentType());
    }

    ObjectNode json() {
        return JsonNodeFactory.instance
                .objectNode()
                .put("url", url)
                .put("sha256", sha256)
                .put("bytes", bytes)
                .put("contentType", contentType);
    }
}
