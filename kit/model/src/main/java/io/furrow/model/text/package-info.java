/** Parts of messages for people. */
package io.furrow.model.text;
