package io.furrow.mission.image;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.time.ZoneOffset;
import java.time.format.DateTimeFormatter;
import java.util.Locale;

import io.furrow.model.event.FiwareScope;
import io.furrow.model.text.Sha256;

/**
 * Where an image is kept below the root: {@code <domain>/<mission>/<entity id>/<entity id>_<yyyyMMddHHmmssSSS>.<ext>}, event
 * time in UTC. Entities of a tenant or service path that is not the default are below {@code ~tenant-<tenant>/} and {@code
 * ~path-<service path>/}, so that one id in two of them is two folders. A part of {@code A-Z a-z 0-9 . _ -} that begins with no dot stands as it is; every other byte of its UTF-8 form
 * becomes {@code ~HH}, because HDFS takes no colon and a leading dot hides a file. An absent domain or mission is {@code
 * ~none}; a part that would be longer than {@value #MAX_LENGTH} signs is {@code ~h} and its SHA-256. No two parts share a name.
 *
 * @param folder {@code <domain>/<mission>/<entity id>}, below those of the scope
 * @param file without the extension
 */
public record ImageName(String folder, String file) {
    /** Files under way, to be deleted when they are left behind by a process that died. */
    public static final String UNFINISHED = ".unfinished-";

    /** A file name holds at most 255 bytes: the part, the time, a hash and the mark of a file under way must fit in. */
    private static final int MAX_LENGTH = 120;

    private static final DateTimeFormatter TIME =
            DateTimeFormatter.ofPattern("uuuuMMddHHmmssSSS", Locale.ROOT).withZone(ZoneOffset.UTC);

    /** The beginnings of folders of a scope: no part begins so. */
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

    /** Whether a folder is that of a tenant or service path, with the folders of domains in it. */
    static boolean isScope(String folder) {
        return folder.startsWith(TENANT) || folder.startsWith(SERVICE_PATH);
    }

    /** {@code <folder>/<file>.<extension>}. */
    public String path(String extension) {
        return folder + "/" + file + "." + extension;
    }

    /** The name of an image whose first name is taken by another one: the same entity, the same millisecond. */
    public String path(String extension, String sha256) {
        return folder + "/" + file + "-" + sha256 + "." + extension;
    }

    /** The time in a file's name. */
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
