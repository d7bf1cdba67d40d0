package io.furrow.ingest.image;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.Sha256;

/** A complete image of a known format, within the size limit. */
record Image(byte[] bytes, ImageFormat format, String sha256) {
    /**
     * @param text of the attribute
     * @throws UnreadableException with {@link Reason#NOT_AN_IMAGE} or {@link Reason#TOO_LARGE}
     */
    static Image of(byte[] text, int limit) throws UnreadableException {
        try {
            return decoded(text, limit);
        } catch (RuntimeException e) { // a defect of a decoder costs an image, not the job
            throw new UnreadableException(Reason.NOT_AN_IMAGE, "the image cannot be decoded: " + e, e);
        }
    }

    private static Image decoded(byte[] text, int limit) throws UnreadableException {
        byte[] bytes = ImageDecoder.decode(text);
        if (bytes.length > limit) {
            throw new UnreadableException(
                    Reason.TOO_LARGE, "the image has " + bytes.length + " bytes, more than the " + limit + " allowed");
        }
        return new Image(bytes, ImageFormat.of(bytes), Sha256.hex(bytes));
    }
}
