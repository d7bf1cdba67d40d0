/** Parts of sentences for people. */
package io.furrow.model.text;
