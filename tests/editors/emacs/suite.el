;;; suite.el --- Gradus in a real Emacs  -*- lexical-binding: t -*-

;; Emacs without a terminal, set up by the very text of docs/editors/emacs.md, does what a
;; person does: reads what a coil does, decides, is told what no longer holds, mends it.
;; What is saved is compared with what the command line writes for the same decisions.
;;
;; ../run starts it, with GRADUS, GRADUS_CORPUS and a HOME of its own.

(require 'cl-lib)
(require 'eglot)
(require 'ert)
(require 'json)

(defconst suite-repository
  (expand-file-name "../../.." (file-name-directory (or load-file-name buffer-file-name))))
(defconst suite-cases
  (with-temp-buffer
    (insert-file-contents (expand-file-name "tests/editors/cases.json" suite-repository))
    (json-parse-buffer :object-type 'plist)))
(defconst suite-tank (plist-get suite-cases :neutralization))
(defconst suite-folder (file-name-as-directory (make-temp-file "gradus-emacs-" t)))

;; No .git above: a folder that is no project, as exports lie around.
(setq temporary-file-directory suite-folder
      make-backup-files nil
      auto-save-default nil
      create-lockfiles nil
      native-comp-jit-compilation nil
      eglot-sync-connect 30
      eldoc-idle-delay 0)

(defun suite-read (file)
  "What FILE holds."
  (with-temp-buffer
    (insert-file-contents file)
    (buffer-string)))

(defun suite-documented ()
  "What the page for users tells them to put into their init file."
  (with-temp-buffer
    (insert-file-contents (expand-file-name "docs/editors/emacs.md" suite-repository))
    (search-forward "```elisp\n")
    (buffer-substring (point) (progn (search-forward "\n```") (match-beginning 0)))))

(defun suite-gradus (&rest arguments)
  "What the command line answers to ARGUMENTS; it must end with 0."
  (with-temp-buffer
    (let ((status (apply #'call-process (getenv "GRADUS") nil '(t nil) nil arguments)))
      (unless (eq status 0) (error "gradus %s ended with %s: %s" arguments status (buffer-string)))
      (buffer-string))))

(defun suite-wait (what holds)
  "Wait until HOLDS returns something, and return that.  WHAT says what is waited for."
  (let ((end (+ (float-time) 30)) found)
    (while (and (not (setq found (funcall holds))) (< (float-time) end))
      (accept-process-output nil 0.05)
      (run-hooks 'post-command-hook))
    (or found (error "Waited in vain: %s" what))))

(defun suite-open (name source)
  "Open a copy of SOURCE called NAME, and wait until the server knows it."
  (let ((file (expand-file-name name suite-folder)))
    (copy-file source file)
    (switch-to-buffer (find-file-noselect file))
    (run-hooks 'post-command-hook)
    (unless (derived-mode-p 'gradus-ladder-mode) (call-interactively #'eglot))
    (suite-wait "the server" #'eglot-managed-p)
    file))

(defun suite-open-tank (name)
  "Open a copy of the neutralization program called NAME."
  (suite-open (concat name ".ladder") (expand-file-name (plist-get suite-tank :file) suite-repository)))

(defun suite-go-to (text into)
  "Put point INTO characters into the first place that holds TEXT."
  (goto-char (point-min))
  (search-forward text)
  (goto-char (+ (match-beginning 0) into)))

(defun suite-eldoc ()
  "What is shown of the thing at point."
  (let (said)
    (eglot-hover-eldoc-function (lambda (text &rest _) (setq said text)))
    (substring-no-properties (suite-wait "a hover" (lambda () said)))))

(defun suite-act (title)
  "Take the action at point whose title matches TITLE, and say yes to what is asked.
Return the questions."
  (let* ((actions (append (eglot-code-actions (point)) nil))
         (titles (mapcar (lambda (it) (plist-get it :title)) actions))
         (action (cl-find-if (lambda (it) (string-match-p title (plist-get it :title))) actions))
         questions)
    (unless action (error "No action %s among %S" title titles))
    (cl-letf (((symbol-function 'y-or-n-p) (lambda (prompt) (push prompt questions) t)))
      (eglot-execute (eglot-current-server) action)
      (suite-wait "an edit" (lambda () (cl-some #'buffer-modified-p (suite-buffers)))))
    questions))

(defun suite-buffers ()
  "The buffers of files."
  (cl-remove-if-not #'buffer-file-name (buffer-list)))

(defun suite-tell ()
  "Tell the server what was typed, as Eglot does when Emacs is idle; it never is without a terminal."
  (eglot--signal-textDocument/didChange))

(defun suite-warning ()
  "The first warning in this buffer."
  (cl-find-if (lambda (it) (eq (flymake-diagnostic-type it) 'eglot-warning)) (flymake-diagnostics)))

(defun suite-save-all ()
  "Save every file that was changed."
  (save-some-buffers t))

(defun suite-holds (said words)
  "Fail unless SAID holds WORDS."
  (should (string-search words said)))

(defun suite-with (spec &rest options)
  "Fail unless SPEC is what the command line makes of its ladder with OPTIONS."
  (let ((ladder (concat (file-name-sans-extension spec) ".ladder")))
    (should (equal (suite-read spec) (apply #'suite-gradus "convert" ladder "-o" "-" options)))))

(ert-deftest a-coil-tells-its-conditions ()
  (suite-open-tank "hover")
  (suite-go-to "-> v2" 3)
  (let ((said (suite-eldoc)))
    (seq-do (lambda (words) (suite-holds said words)) (plist-get (plist-get suite-tank :hover) :shows))))

(ert-deftest a-coil-inside-a-real-export-tells-its-conditions ()
  (let* ((real (plist-get suite-cases :real))
         (hover (plist-get real :hover))
         (source (expand-file-name (plist-get real :file) (getenv "GRADUS_CORPUS"))))
    (unless (file-exists-p source)
      (when (equal (getenv "CI") "true") (error "%s: no such file, and CI=true demands the corpus" source))
      (ert-skip "no corpus"))
    (suite-open "real.L5X" source)
    (should (derived-mode-p 'nxml-mode))
    (suite-go-to (plist-get hover :written) (length "OTE("))
    (let ((said (suite-eldoc)))
      (seq-do (lambda (words) (suite-holds said words)) (plist-get hover :shows)))))

(ert-deftest a-decision-makes-the-spec-and-undo-takes-it-back ()
  (let* ((ladder (suite-open-tank "accept"))
         (spec (concat (file-name-sans-extension ladder) ".grafcet"))
         (pair (plist-get (plist-get suite-tank :together) :pair)))
    (suite-gradus "convert" ladder)
    (let ((before (suite-read spec)))
      (suite-go-to "-> v1" 3)
      ;; No buffer shows the spec yet, so Eglot asks.
      (should (suite-act "Accept v1 -> .*together"))
      (suite-save-all)
      (suite-holds (suite-read spec) (plist-get (plist-get suite-tank :together) :decision))
      (suite-with spec "--accept" pair)
      (switch-to-buffer (find-file-noselect spec))
      (undo-boundary)
      (undo)
      (suite-save-all)
      (should (equal (suite-read spec) before)))))

(ert-deftest a-decision-about-a-ladder-without-a-spec-makes-one ()
  (let* ((ladder (suite-open-tank "first"))
         (spec (concat (file-name-sans-extension ladder) ".grafcet")))
    (suite-go-to "-> v1" 3)
    (suite-act "Accept v1 -> .*together")
    (suite-save-all)
    (suite-with spec "--accept" (plist-get (plist-get suite-tank :together) :pair))))

(ert-deftest an-edited-rung-makes-rules-stale-and-they-are-mended ()
  (let* ((ladder (suite-open-tank "stale"))
         (spec (concat (file-name-sans-extension ladder) ".grafcet"))
         (pair (plist-get (plist-get suite-tank :together) :pair))
         (open (current-buffer)))
    (suite-gradus "convert" ladder "--accept" pair)
    (switch-to-buffer (find-file-noselect spec))
    (suite-wait "the server" #'eglot-managed-p)
    (should (derived-mode-p 'grafcet-mode))
    ;; Flymake waits until a buffer is drawn, which nothing is here.
    (flymake-start)
    (with-current-buffer open
      ;; v1 is now closed by the upper level.
      (suite-go-to "/ls2                       -> v1" 1)
      (delete-char (length "ls2"))
      (insert "ls3")
      (suite-tell))
    (suite-wait "a finding" #'suite-warning)
    (cl-loop for found = (suite-warning)
             while found
             do (goto-char (flymake-diagnostic-beg found))
             (suite-act "Take over what the ladder gives")
             (suite-tell)
             (suite-wait "the finding goes" (lambda () (not (memq found (flymake-diagnostics))))))
    (suite-save-all)
    (suite-with spec "--accept" pair)
    (suite-gradus "check" ladder spec)))

(defun suite-close (&rest _)
  "Close every file, changed or not."
  (dolist (buffer (suite-buffers))
    (with-current-buffer buffer (set-buffer-modified-p nil))
    (kill-buffer buffer)))

(let ((bin (expand-file-name "bin/" suite-folder)))
  (make-directory bin)
  (make-symbolic-link (getenv "GRADUS") (expand-file-name "gradus" bin))
  (push bin exec-path)
  (setenv "PATH" (concat bin path-separator (getenv "PATH"))))
(with-temp-buffer
  (insert (suite-documented))
  (eval-buffer))

(let (failed)
  (dolist (test (ert-select-tests t t))
    (let ((result (ert-run-test test)))
      (suite-close)
      (princ (format "%s %s\n"
                     (cond ((ert-test-skipped-p result) "skip") ((ert-test-passed-p result) "ok  ") (t "FAIL"))
                     (replace-regexp-in-string "-" " " (symbol-name (ert-test-name test)))))
      (unless (or (ert-test-skipped-p result) (ert-test-passed-p result))
        (setq failed t)
        (princ (format "%S\n" (ert-test-result-with-condition-condition result))))))
  (delete-directory suite-folder t)
  (kill-emacs (if failed 1 0)))
;;; suite.el ends here
