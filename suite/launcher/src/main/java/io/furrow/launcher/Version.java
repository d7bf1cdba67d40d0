package io.furrow.launcher;

/** Prints the release from the manifest of its jar. Needs no other class, so that {@code furrow --version} is fast. */
final class Version {
    static final String TEXT = "furrow " + release();

    private Version() {}

    public static void main(String... args) {
        System.out.println(TEXT);
    }

    private static String release() {
        String release = Version.class.getPackage().getImplementationVersion();
        return release == null ? "of no release" : release;
    }
}
