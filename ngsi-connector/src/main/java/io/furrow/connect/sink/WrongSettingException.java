package io.furrow.connect.sink;

/** No request can succeed until a setting is changed. */
final class WrongSettingException extends Exception {
    private static final long serialVersionUID = 1L;

    WrongSettingException(String words) {
        super(words);
    }
}
