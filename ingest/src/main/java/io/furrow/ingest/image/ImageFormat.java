package io.furrow.ingest.image;

import java.nio.ByteBuffer;
import java.util.zip.CRC32;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The supported formats, detected by the bytes, never by a sender's declaration. Structure and end are checked; the
 * pixels are not decoded.
 */
enum ImageFormat {
    /** Chunks from {@code IHDR} to {@code IEND}, each with a correct checksum (ISO/IEC 15948). */
    PNG("image/png", "png") {
        @Override
        void check(ByteBuffer image) throws UnreadableException {
            image.position(PNG_SIGNATURE_BYTES);
            boolean pixels = false;
            for (boolean first = true; ; first = false) {
                int type = chunk(image);
                if (first
                        && (type != IHDR
                                || image.position() != PNG_HEADER_END
                                || image.getInt(16) <= 0
                                || image.getInt(20) <= 0)) {
                    throw broken(this, "does not begin with a header that has a size");
                }
                pixels |= type == IDAT;
                if (type == IEND && pixels) {
                    return; // data after the end, which cameras may add, is harmless
                }
                if (type == IEND) {
                    throw broken(this, "has no pixels");
                }
            }
        }

        /** Passes one chunk and returns its type. */
        private int chunk(ByteBuffer image) throws UnreadableException {
            if (image.remaining() < PNG_CHUNK_FRAME) {
                throw broken(this, "is cut off");
            }
            int length = image.getInt();
            if (length < 0 || length > image.remaining() - (PNG_CHUNK_FRAME - Integer.BYTES)) {
                throw broken(this, "is cut off");
            }
            int type = image.getInt(image.position());
            CRC32 crc = new CRC32();
            crc.update(image.slice(image.position(), Integer.BYTES + length));
            image.position(image.position() + Integer.BYTES + length);
            if (image.getInt() != (int) crc.getValue()) {
                throw broken(this, "has a chunk with a wrong checksum");
            }
            return type;
        }
    },
    /** Marker segments with a frame header before the first scan, and an end of image (ITU-T T.81). */
    JPEG("image/jpeg", "jpg") {
        @Override
        void check(ByteBuffer image) throws UnreadableException {
            image.position(2);
            boolean frame = false;
            while (true) {
                int marker = marker(image);
                if (marker == JPEG_END) {
                    throw broken(this, "has no pixels");
                }
                int length = image.remaining() < 2 ? 0 : image.getShort(image.position()) & 0xffff;
                if (length < 2 || length > image.remaining()) {
                    throw broken(this, "is cut off");
                }
                frame |= marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
                image.position(image.position() + length);
                if (marker == JPEG_SCAN) {
                    break;
                }
            }
            if (!frame) {
                throw broken(this, "has no frame header");
            }
            checkEnd(image);
        }

        private int marker(ByteBuffer image) throws UnreadableException {
            int sign = image.hasRemaining() ? image.get() & 0xff : 0;
            while (sign == 0xff && image.hasRemaining()) {
                int code = image.get() & 0xff;
                if (code != 0xff) {
                    return code;
                }
            }
            throw broken(this, "has something else where a marker should be, or is cut off");
        }

        private void checkEnd(ByteBuffer image) throws UnreadableException {
            for (int i = image.limit() - 1; i > image.position(); i--) {
                if ((image.get(i) & 0xff) == JPEG_END && (image.get(i - 1) & 0xff) == 0xff) {
                    return;
                }
            }
            throw broken(this, "is cut off");
        }
    };

    private static final long PNG_SIGNATURE = 0x89504E470D0A1A0AL;
    private static final int PNG_SIGNATURE_BYTES = 8;
    /** Length, type and checksum. */
    private static final int PNG_CHUNK_FRAME = 12;

    /** Of the signature and a header of 13 bytes. */
    private static final int PNG_HEADER_END = PNG_SIGNATURE_BYTES + PNG_CHUNK_FRAME + 13;

    private static final int IHDR = 0x49484452;
    private static final int IDAT = 0x49444154;
    private static final int IEND = 0x49454E44;
    private static final int JPEG_SCAN = 0xDA;
    private static final int JPEG_END = 0xD9;

    private final String contentType;
    private final String extension;

    ImageFormat(String contentType, String extension) {
        this.contentType = contentType;
        this.extension = extension;
    }

    /** @throws UnreadableException if they are neither, or incomplete */
    static ImageFormat of(byte[] bytes) throws UnreadableException {
        ByteBuffer image = ByteBuffer.wrap(bytes);
        ImageFormat format = null;
        if (bytes.length >= PNG_SIGNATURE_BYTES && image.getLong(0) == PNG_SIGNATURE) {
            format = PNG;
        } else if (bytes.length >= Integer.BYTES && (image.getInt(0) & 0xFFFFFF00) == 0xFFD8FF00) {
            format = JPEG;
        }
        if (format == null) {
            throw new UnreadableException(Reason.NOT_AN_IMAGE, "the bytes are neither PNG nor JPEG");
        }
        format.check(image);
        return format;
    }

    abstract void check(ByteBuffer image) throws UnreadableException;

    String contentType() {
        return contentType;
    }

    public String extension() {
        return extension;
    }

    private static UnreadableException broken(ImageFormat format, String how) {
        return new UnreadableException(Reason.NOT_AN_IMAGE, "the " + format + " " + how);
    }
}
