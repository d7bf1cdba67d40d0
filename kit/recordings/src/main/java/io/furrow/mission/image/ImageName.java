package io.furrow.mission.image;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.Locale;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.text.Sha256;

/**
 * The path of an image below the root: {@code <domain>/<mission>/<entity id>/<entity id>_<yyyyMMddHHmmssSSS>.<ext>},
 * with the event time in UTC. Entities of a tenant or service path other than the default are below {@code
 * ~tenant-<tenant>/} and {@code ~path-<service path>/}, so that an id in two of them has two folders. A part of {@code
 * A-Z a-z 0-9 . _ -} without a leading dot stays as it is; every other byte of its UTF-8 form becomes {@code ~HH},
 * because HDFS allows no colon and a leading dot hides a file. An absent domain or mission is {@code ~none}; a part
 * longer than {@value #MAX_LENGTH} characters is {@code ~h} and its SHA-256. No two parts share a name.
 *
 * @param folder {@code <domain>/<mission>/<entity id>}, below those of the scope
 * @param file without the extension
 */
public record ImageName(String folder, String file) {
    /** Prefix of incomplete files, which are deleted if their process died. */
    public static final String UNFINISHED = ".unfinished-";

    /** A file name has at most 255 bytes for the part, the time, a hash and the prefix of an incomplete file. */
    private static final int MAX_LENGTH = 120;

    private static final DateTimeFormatter TIME =
            DateTimeFormatter.ofPattern("uuuuMMddHHmmssSSS", Locale.ROOT).withZone(ZoneOffset.UTC);

    /** Prefixes of the folders of a scope; no encoded part has them. */
    private static final String TENANT = "~tenant-";

    private static final String SERVICE_PATH = "~path-";

    public static ImageName of(FiwareScope scope, String domain, String mission, String entityId, long eventTime) {
        String entity = part(entityId);
        return new ImageName(
                folder(scope) + part(domain) + "/" + part(mission) + "/" + entity,
                entity + "_" + TIME.format(Instant.ofEpochMilli(eventTime)));
    }

    private static String folder(FiwareScope scope) {
        String tenant = scope.service().isEmpty() ? "" : TENANT + part(scope.service()) + "/";
        boolean isRoot = scope.servicePath().equals(FiwareScope.DEFAULT.servicePath());
        return isRoot ? tenant : tenant + SERVICE_PATH + part(scope.servicePath()) + "/";
    }

    /** Returns whether a folder is that of a tenant or service path, which contains folders of domains. */
    static boolean isScope(String folder) {
        return folder.startsWith(TENANT) || folder.startsWith(SERVICE_PATH);
    }

    /** Returns {@code <folder>/<file>.<extension>}. */
    public String path(String extension) {
        return folder + "/" + file + "." + extension;
    }

    /** Returns an alternative name for a different image of the same entity and millisecond. */
    public String path(String extension, String sha256) {
        return folder + "/" + file + "-" + sha256 + "." + extension;
    }

    /** Parses the time in a file's name. */
    public static Instant time(String digits) {
        return TIME.parse(digits, Instant::from);
    }

    public static String part(String name) {
        if (name.isEmpty()) {
            return "~none";
        }
        StringBuilder safe = new StringBuilder();
        for (byte b : name.getBytes(StandardCharsets.UTF_8)) {
            boolean alphanumeric = b >= '0' && b <= '9' || b >= 'A' && b <= 'Z' || b >= 'a' && b <= 'z';
            boolean plain = alphanumeric || b == '_' || b == '-' || b == '.' && safe.length() > 0;
            safe.append(plain ? String.valueOf((char) b) : String.format("~%02X", b));
        }
        return safe.length() <= MAX_LENGTH ? safe.toString() : "~h" + Sha256.hex(name);
    }
}
